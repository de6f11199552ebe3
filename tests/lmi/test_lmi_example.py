"""The stand-alone example of docs/lmi.md runs as printed, and its certificate verifies from the command line."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_twenty_lines_run_and_verify(tmp_path):
    text = (ROOT / "docs" / "lmi.md").read_text(encoding="utf-8")
    program = re.search(r"## Twenty lines\n+```python\n(.*?)```", text, re.S)[1]
    run = {"cwd": tmp_path, "capture_output": True, "text": True, "env": {"PYTHONPATH": str(ROOT / "src")}}
    done = subprocess.run([sys.executable, "-c", program], **run, check=True)
    assert "<= optimum <=" in done.stdout
    checked = subprocess.run([sys.executable, "-m", "recontrol.lmi.verify", "upper.json"], **run, check=False)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "holds, exact" in checked.stdout
    (tmp_path / "upper.json").write_text((tmp_path / "upper.json").read_text().replace("gain", "pain"))
    refused = subprocess.run([sys.executable, "-m", "recontrol.lmi.verify", "upper.json"], **run, check=False)
    assert refused.returncode == 1
    assert "digest" in refused.stdout

"""The made-up paper of these tests, built once."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import fake

from recontrol import report


@pytest.fixture(scope="session")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project tree whose report has been built."""
    root = fake.write(tmp_path_factory.mktemp("project"))
    report.build(root, [fake.KEY])
    return root

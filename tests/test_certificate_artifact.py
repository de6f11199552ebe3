"""A certificate survives the artifact store: what a reading gets still has its digest."""

import pytest

from recontrol.exact.rational import matrix
from recontrol.lmi import verify
from recontrol.lmi.loops import prove_stable
from recontrol.pipeline import inputs, store
from recontrol.pipeline.encode import dumps
from recontrol.pipeline.layout import artifact


@pytest.fixture
def stored(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("RECONTROL_RUN", raising=False)
    certificate = prove_stable(matrix("0 1\n-2 -3"))
    path = artifact("fake2020", "certificates", "loop")
    store.publish({str(path): dumps(certificate).encode()}, {})
    return path


def test_a_reading_gets_a_certificate_that_verifies(stored):
    found = inputs.Parts("fake2020", "certificates", ["loop"])["loop"]
    assert verify.check(found).holds
    # The way of all other artifacts turns its lists of integers into arrays.
    assert not verify.check(store.read_json(stored)).holds

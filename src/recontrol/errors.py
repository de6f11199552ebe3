"""Errors that a user can cause or meet; every message names the file, what was found and the way out."""


class RecontrolError(Exception):
    """Base class: the command line prints the message alone, without a traceback."""


class PaperError(RecontrolError, ValueError):
    """A paper folder is malformed."""


class UnknownNameError(RecontrolError, KeyError):
    """A name (paper, datum, part, claim) that does not exist."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class ArtifactError(RecontrolError, RuntimeError):
    """An artifact is missing, truncated, edited by hand or not what its record says."""


class MissingArtifactError(ArtifactError):
    """An artifact that an earlier stage should have made does not exist."""


class StageError(RecontrolError, RuntimeError):
    """A stage function is missing, broke its contract or returned something unusable."""


class ValueContractError(RecontrolError, ValueError):
    """A reading returned a value that cannot be compared (bare float, wrong shape, not finite)."""

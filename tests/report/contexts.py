"""A cache with the JSON-LD contexts of RO-Crate, so that the validator needs no network.

The `rocrate` package ships the context of 1.3. In that of 1.1 four terms have other addresses, else the check of
the type of the main workflow fails.
"""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path

import requests_cache
from requests_cache.models import CachedRequest, CachedResponse

VERSIONS = ("1.1", "1.2", "1.3")
OF_1_1 = {
    "ComputationalWorkflow": "https://bioschemas.org/ComputationalWorkflow",
    "FormalParameter": "https://bioschemas.org/FormalParameter",
    "input": "https://bioschemas.org/ComputationalWorkflow#input",
    "output": "https://bioschemas.org/ComputationalWorkflow#output",
}


def seed(path: Path) -> Path:
    """Write the cache and return the name that `rocrate-validator --cache-path` takes."""
    shipped = json.loads(files("rocrate").joinpath("data", "ro-crate.jsonld").read_text(encoding="utf-8"))
    cache = requests_cache.CachedSession(str(path), backend="sqlite").cache
    for version in VERSIONS:
        context = dict(shipped["@context"]) | (OF_1_1 if version == "1.1" else {})
        address = f"https://w3id.org/ro/crate/{version}/context"
        headers = {"Content-Type": "application/ld+json"}
        body = json.dumps({"@context": context}).encode()
        request = CachedRequest(method="GET", url=address, headers={})
        cache.save_response(
            CachedResponse(status_code=200, url=address, headers=headers, content=body, request=request)
        )
    return path

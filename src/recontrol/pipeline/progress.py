"""How far a running campaign has come, and what remains."""

from __future__ import annotations

import sys
import threading
import time

from recontrol.pipeline.layout import chunk_ranges, chunks_file

Sizes = tuple[int, int, int]
"""Chunks of a campaign, chunks in a job, chunks of every run: the arguments of `chunk_ranges`."""


def finished(targets: list[str], sizes: Sizes) -> int:
    """How many chunks of some campaigns (`paper/name`) are there."""
    return sum(
        last - first + 1
        for key, name in (target.split("/", 1) for target in targets)
        for first, last in chunk_ranges(*sizes)
        if chunks_file(key, name, first, last).exists()
    )


def progress(targets: list[str], sizes: Sizes, new: int = 0, seconds: float = 0.0) -> str:
    """How far a campaign has come, and what remains at the pace of the `new` chunks of the last `seconds`."""
    total, done = len(targets) * sizes[0], finished(targets, sizes)
    text = f"campaign: {done} of {total} chunks"
    if done == total or not new:
        return text
    remaining = (total - done) * seconds / new
    return text + (
        f", about {remaining:.0f} s remain" if remaining < 120 else f", about {remaining / 60:.0f} min remain"
    )


def watch(targets: list[str], sizes: Sizes, every: float = 20.0) -> None:
    """Print the progress of the running campaign now and then, from a thread that ends with the process."""
    begin, first = time.monotonic(), finished(targets, sizes)

    def show() -> None:
        while True:
            new = finished(targets, sizes) - first
            print(progress(targets, sizes, new, time.monotonic() - begin), file=sys.stderr, flush=True)
            time.sleep(every)

    threading.Thread(target=show, daemon=True).start()

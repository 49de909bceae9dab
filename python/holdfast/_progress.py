"""What a job calls while it runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Optional


@contextmanager
def watch_of(job: str, progress: Any) -> Iterator[Optional[Callable[[int, int], None]]]:
    """None, the callable that was given, or a bar of tqdm (True), which goes without where tqdm is not
    installed."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"progress = {progress!r}: admissible are True, False and a callable (done, total)")
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(desc=job, leave=False) as bar:

        def watch(done: int, total: int) -> None:
            bar.total = total
            bar.n = done
            bar.refresh()

        yield watch

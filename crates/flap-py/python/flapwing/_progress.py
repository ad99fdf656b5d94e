"""How far a sweep is."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Callable, Iterator, Optional, Union

#: What may be given as ``progress``.
Progress = Union[bool, Callable[[int, int], object]]


@contextmanager
def shown(progress: Progress) -> Iterator[Optional[Callable[[int, int], object]]]:
    """What to call with the number of points done and of points in all."""
    if not progress:
        yield None
    elif callable(progress):
        yield progress
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True needs tqdm: pip install tqdm, or give a function") from None

        with tqdm(unit=" points", unit_scale=True) as bar:

            def show(done: int, points: int) -> None:
                bar.total = points
                bar.update(done - bar.n)

            yield show

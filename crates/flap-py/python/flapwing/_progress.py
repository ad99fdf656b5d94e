"""The progress of long function calls, shown as a progress bar or reported to a function of the user."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: The type of the argument ``progress``.
Progress = bool | Callable[[int, int], object]


@contextmanager
def shown(progress: Progress) -> Iterator[Callable[[int, int], object] | None]:
    """Yield the progress function, which shows or reports the progress. The arguments of the progress function are the
    number of finished points and the number of all points. Yield None if no progress is shown.
    """
    if callable(progress):
        yield progress
    elif not isinstance(progress, bool):
        raise TypeError(
            f"`progress` is {type(progress).__name__}\n"
            "it must be True, False, or a function of two numbers: points done, points"
        )
    elif not progress:
        yield None
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True requires tqdm: pip install tqdm, or give a function") from None

        with tqdm(unit=" points", unit_scale=True) as bar:

            def show(done: int, points: int) -> None:
                bar.total = points
                bar.update(done - bar.n)

            yield show


@contextmanager
def one_step(progress: Progress) -> Iterator[None]:
    """Report one step of progress at the end of the computation of a single point."""
    with shown(progress) as show:
        yield
        if show is not None:
            show(1, 1)

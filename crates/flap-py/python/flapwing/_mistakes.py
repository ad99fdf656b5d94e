"""Errors of arguments: values of a wrong type, objects whose own code fails, and names that are not known."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

#: Names that the error lists.
_LISTED = 12


class UnknownName(KeyError, ValueError):
    """A name that is not known: a KeyError, as of a dictionary, and a ValueError, as of other arguments."""

    def __str__(self) -> str:
        # A KeyError would show its message in quotes, on one line.
        return str(self.args[0])


def unknown(kind: str, name: object, known: Iterable[str]) -> UnknownName:
    """The error for a `name` that is none of the `known` ones: first the nearest of them, then the first few."""
    names = list(known)
    near = difflib.get_close_matches(str(name), names, n=1)
    hint = f", did you mean `{near[0]}`?" if near else ""
    return UnknownName(f"there is no {kind} `{name}`{hint}\n{listed(names)}")


def listed(names: Iterable[str]) -> str:
    """The first few of the names that there are."""
    every = list(names)
    more = f" and {len(every) - _LISTED} more" if len(every) > _LISTED else ""
    return (
        f"there {'is' if len(every) == 1 else 'are'} {', '.join(every[:_LISTED])}{more}" if every else "there are none"
    )


def refused(name: str, value: object, allowed: str) -> TypeError:
    """The error for a value of the wrong type, in two lines."""
    return TypeError(f"`{name}` is {type(value).__name__}\n{allowed}")


@contextmanager
def reading(name: str, value: object, allowed: str) -> Iterator[None]:
    """Makes a TypeError of what the code of `value` raises while it is read. KeyboardInterrupt and its like pass."""
    try:
        yield
    except OverflowError as error:
        raise ValueError(f"`{name}` has a number that is too large for a 64-bit float\n{allowed}") from error
    except Exception as error:
        raise TypeError(f"`{name}` is {type(value).__name__}, which raised {raised(error)}\n{allowed}") from error


def raised(error: BaseException) -> str:
    """An exception in one line, for messages."""
    try:
        first = next(iter(str(error).splitlines()), "")
    except Exception:
        first = ""
    told = f"{first:.200}"
    return f"{type(error).__name__}: {told}" if told else type(error).__name__

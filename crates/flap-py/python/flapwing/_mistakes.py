"""Exceptions for wrong arguments: values of a wrong type, objects that cannot be read, and unknown names. The module
also computes the stack level at which warnings are shown."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

#: Largest number of names in an error message.
_LISTED = 12

#: Smallest similarity, from 0 to 1, of a misspelt name with the argument that an error message suggests.
_NEAR = 0.85


class UnknownName(KeyError, ValueError):
    """The exception for an unknown name. You can catch an `UnknownName` error as a KeyError or as a ValueError."""

    def __str__(self) -> str:
        # Without this, a KeyError shows its message in quotes on one line.
        return str(self.args[0])


def unknown(kind: str, name: object, known: Iterable[str]) -> UnknownName:
    """Return the exception for a `name` that is not in `known`. The error message has the most similar known name and
    the first few known names.
    """
    names = list(known)
    near = difflib.get_close_matches(str(name), names, n=1)
    hint = f", did you mean `{near[0]}`?" if near else ""
    return UnknownName(f"there is no {kind} `{name}`{hint}\n{known_names(names)}")


def known_names(names: Iterable[str]) -> str:
    """Return a sentence that lists the first few of the known names, for error messages."""
    every = list(names)
    if not every:
        return "there are none"
    more = f" and {len(every) - _LISTED} more" if len(every) > _LISTED else ""
    return f"there {'is' if len(every) == 1 else 'are'} {', '.join(every[:_LISTED])}{more}"


def refused(name: str, value: object, allowed: str) -> TypeError:
    """Return the TypeError for a value of the wrong type, with a message of two lines."""
    return TypeError(f"`{name}` is {type(value).__name__}\n{allowed}")


@contextmanager
def reading(name: str, value: object, allowed: str) -> Iterator[None]:
    """Convert an exception in the `with` block, which reads `value`, to a TypeError. An OverflowError becomes a
    ValueError. KeyboardInterrupt and similar exceptions are raised unchanged.
    """
    try:
        yield
    except OverflowError as error:
        raise ValueError(f"`{name}` has a number that is too large for a 64-bit float\n{allowed}") from error
    except Exception as error:
        raise TypeError(f"`{name}` is {type(value).__name__}, which raised {raised(error)}\n{allowed}") from error


def raised(error: BaseException) -> str:
    """Return the type and the first line of an exception as one line of text, for error messages."""
    try:
        message = next(iter(str(error).splitlines()), "")
    except Exception:
        message = ""
    return f"{type(error).__name__}: {message:.200}" if message else type(error).__name__


def near_argument(name: str) -> str | None:
    """Return the argument of the user's call that is most similar to `name`, or None if no argument is similar."""
    frame = sys._getframe()
    while frame.f_back is not None and str(frame.f_back.f_globals.get("__name__")).startswith("flapwing."):
        frame = frame.f_back
    code = frame.f_code
    arguments = code.co_varnames[code.co_posonlyargcount : code.co_argcount + code.co_kwonlyargcount]
    near = difflib.get_close_matches(name, arguments, n=1, cutoff=_NEAR)
    return near[0] if near else None


def callers_level() -> int:
    """Return the stack level of the user's call, counted from the function that calls `callers_level`."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).startswith("flapwing."):
        level, frame = level + 1, frame.f_back
    return level

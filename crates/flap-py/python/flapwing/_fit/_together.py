"""Several searches side by side: what they ask next is answered in one batch."""

from __future__ import annotations

import queue
import threading
from typing import Any, Callable, Sequence, TypeVar

from ._model import Answer
from ._types import Array

Found = TypeVar("Found")

#: A question: the model at a set of coordinates.
Ask = Callable[[Array], Answer]


class _Ended(Exception):
    """The searches end, because the one that answers has."""


def together(searches: Sequence[Callable[[Ask], Found]], answer: Callable[[list[Array]], list[Answer]]) -> list[Found]:
    """The results of the searches, each of which asks for the model one set of coordinates at a time.

    Searches run in threads; `answer` is called in this one, with the questions of all searches that have not ended. So
    Ctrl-C ends all of them.
    """
    inbox: queue.SimpleQueue[tuple[int, str, Any]] = queue.SimpleQueue()
    replies: list[queue.SimpleQueue[Answer | None]] = [queue.SimpleQueue() for _ in searches]

    def work(place: int) -> None:
        def ask(x: Array) -> Answer:
            inbox.put((place, "asks", x.copy()))
            reply = replies[place].get()
            if reply is None:
                raise _Ended
            return reply

        try:
            inbox.put((place, "found", searches[place](ask)))
        except _Ended:
            pass
        except BaseException as error:  # told by the thread that waits
            inbox.put((place, "failed", error))

    threads = [threading.Thread(target=work, args=(place,), daemon=True) for place in range(len(searches))]
    for thread in threads:
        thread.start()
    found: dict[int, Found] = {}
    asked: dict[int, Array] = {}
    try:
        while len(found) < len(searches):
            place, kind, content = inbox.get()
            if kind == "failed":
                raise content
            if kind == "found":
                found[place] = content
            else:
                asked[place] = content
            if asked and len(asked) + len(found) == len(searches):
                places = sorted(asked)
                answers = answer([asked[place] for place in places])
                asked = {}
                for place, one in zip(places, answers):
                    replies[place].put(one)
    finally:
        for reply in replies:
            reply.put(None)
    return [found[place] for place in range(len(searches))]

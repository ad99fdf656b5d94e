"""The works, by name: the first is the one that is done unless another is asked for."""

from __future__ import annotations

from .integration import INTEGRATION
from .settled import RESPONSES, SETTLED
from .work import Work

WORKS: dict[str, Work] = {work.name: work for work in (INTEGRATION, SETTLED, RESPONSES)}

"""All benchmarks by name. The first benchmark is the default."""

from __future__ import annotations

from .integration import INTEGRATION
from .settled import RESPONSES, SETTLED
from .work import Work

WORKS: dict[str, Work] = {work.name: work for work in (INTEGRATION, SETTLED, RESPONSES)}

"""Types of the fit's modules."""

from __future__ import annotations

from typing import Any

import numpy as np

#: Numbers.
Array = np.ndarray[Any, np.dtype[np.float64]]

#: Truth values.
Mask = np.ndarray[Any, np.dtype[np.bool_]]

#: Places in an array.
Places = np.ndarray[Any, np.dtype[np.intp]]

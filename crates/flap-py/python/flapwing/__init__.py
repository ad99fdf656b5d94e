"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs; `run` simulates one of them, with any parameters changed.
"""

from ._flapwing import __version__, presets, run

__all__ = ["__version__", "presets", "run"]

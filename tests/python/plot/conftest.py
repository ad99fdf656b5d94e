"""Fixtures of the tests of pictures."""

import flapwing
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest
from figures import HERTZ, VOLTS


@pytest.fixture(autouse=True)
def nothing_is_left():
    """No picture changes matplotlib's settings; figures are closed."""
    before = matplotlib.rcParams.copy()
    yield
    assert matplotlib.rcParams == before
    plt.close("all")


@pytest.fixture(scope="session")
def sweep():
    """A small sweep of the direct drive: voltage by frequency."""
    return flapwing.sweep({"preset": "ozaki2018-large", "axes": {"drive_voltage_pp": VOLTS, "drive_frequency": HERTZ}})


@pytest.fixture(scope="session")
def motion():
    """Two cycles of the direct drive."""
    return flapwing.trajectory("ozaki2018-large")

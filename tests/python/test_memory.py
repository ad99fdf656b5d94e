"""Nothing is kept of calls that have ended."""

import gc
import os

import flapwing
import pytest

CALLS = 2000
PRESET = "ozaki2018-large"


def resident():
    """Bytes of memory that the process holds."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


def call(number):
    """One call of every kind; most of the work is at the border."""
    kind = number % 5
    if kind == 0:
        flapwing.run(PRESET, rtol=1e-2, settle_tol=1e-1, max_cycles=2)
    elif kind == 1:
        flapwing.evaluate(
            PRESET, {"drive_frequency": [100.0, 105.0]}, threads=1, rtol=1e-2, settle_tol=0.1, max_cycles=2
        )
    elif kind == 2:
        list(flapwing.Grid({"preset": PRESET, "axes": {"drive_frequency": [1.0, 2.0]}}))
    elif kind == 3:
        with pytest.raises(flapwing.GridError):
            flapwing.Grid({"preset": PRESET, "axes": {"drive_frequenc": [1.0, 2.0]}})
    else:
        flapwing.trajectory(PRESET, cycles=1, samples=100, from_rest=True, rtol=1e-2)["stroke_deg"].sum()


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="reads /proc")
def test_no_leak_over_thousands_of_calls():
    for number in range(CALLS // 2):
        call(number)
    gc.collect()
    before = resident()
    for number in range(CALLS):
        call(number)
    gc.collect()
    # 300 bytes a call are 600 kB.
    assert resident() - before < 600_000

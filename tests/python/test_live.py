"""The live page from Python: a server with the rows of `sweep`, a cell of a notebook, a widget."""

import json
import math
import os
import subprocess
import sys
import urllib.error
import urllib.request

import flapwing
import pytest


def ask(page, kind, body, token=None):
    """The answer of a server to a request of its page."""
    base, own = page.address.split("/?token=")
    headers = {"X-Flap-Token": token or own, "Content-Type": "application/json"}
    request = urllib.request.Request(f"{base}/api/{kind}", json.dumps(body).encode(), headers)
    with urllib.request.urlopen(request, timeout=60) as answer:
        return json.load(answer)


FAMILY = {
    "design": {"air_density": 1.1},
    "x": {"name": "drive_frequency", "from": 100.0, "to": 116.0, "n": 5},
    "by": {"name": "drive_voltage_pp", "values": [60.0, 80.0]},
}


def test_rows_of_the_page_are_those_of_a_sweep():
    with flapwing.live("ozaki2018-large", hinge_stiffness="120 uN*m/rad", rtol=1e-7, threads=1) as page:
        answer = ask(page, "family", FAMILY)
        lines = ask(page, "save", {"kind": "python", **FAMILY})["text"]
    found = {}
    exec(lines, found)  # the lines that the page offers
    table = found["table"]
    assert answer["columns"] == list(table.columns)
    for name, column in zip(answer["columns"], zip(*answer["rows"])):
        # JSON has no nan.
        shown = [None if isinstance(cell, float) and math.isnan(cell) else cell for cell in table[name].tolist()]
        assert list(column) == shown, name
    grid = {
        "preset": "ozaki2018-large",
        "axes": {"drive_voltage_pp": [60.0, 80.0], "drive_frequency": {"from": 100.0, "to": 116.0, "n": 5}},
    }
    same = flapwing.sweep(grid, hinge_stiffness="120 uN*m/rad", rtol=1e-7, air_density=1.1)
    assert (same["lift_mean_mn"] == table["lift_mean_mn"]).all()


def test_a_server_ends():
    page = flapwing.live("ozaki2018-small")
    assert ask(page, "motion", {"samples": 9})["columns"][0] == "time_s"
    page.stop()
    with pytest.raises(urllib.error.URLError):
        ask(page, "motion", {"samples": 9})
    page.stop()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no forks on this system")
@pytest.mark.parametrize("end", ["page.stop()", "del page; gc.collect()", "page.__exit__(None, None, None)", "pass"])
def test_a_forked_child_leaves_the_page_to_its_parent(end):
    program = f"""
import gc, os, sys, urllib.request, warnings, flapwing
warnings.simplefilter("ignore")
page = flapwing.live("ozaki2018-small")
address = page.address
child = os.fork()
if child == 0:
    {end}
    sys.exit(0)
_, status = os.waitpid(child, 0)
print(status, urllib.request.urlopen(address, timeout=30).status)
page.stop()
try:
    urllib.request.urlopen(address, timeout=5)
except OSError:
    print("stopped")
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=120)
    assert (ended.stdout, ended.stderr) == ("0 200\nstopped\n", "")


def test_strangers_are_turned_away():
    with flapwing.live("ozaki2018-small") as page:
        with pytest.raises(urllib.error.HTTPError, match="401"):
            ask(page, "motion", {"samples": 9}, token="0" * 32)


def test_the_page_stands_in_a_cell_and_in_a_widget():
    with flapwing.live("ozaki2018-small") as page:
        assert f'src="{page.address}"' in page._repr_html_()
        widget = page.widget(height=500)
        assert (widget.address, widget.height) == (page.address, 500)
        assert "iframe" in str(widget._esm)
        with pytest.raises(ValueError, match="must be 1 or more"):
            page.widget(height=0)


def test_mistakes():
    with flapwing.live("ozaki2018-small") as page:
        port = int(page.address.split(":")[2].split("/")[0])
        with pytest.raises(OSError, match="cannot listen on port"):
            flapwing.live("ozaki2018-small", port=port)
    with pytest.raises(ValueError, match="it must be from 1 to 65535"):
        flapwing.live("ozaki2018-small", port=70000)
    for port in ("8000", True):
        with pytest.raises(TypeError, match="`port` must be a whole number"):
            flapwing.live("ozaki2018-small", port=port)
    with pytest.raises(ValueError, match="must be zero or more"):
        flapwing.live("ozaki2018-small", air_density=-1)

"""Time to the first picture of a large page of results, and time of each step of a filter's slider, in a headless
browser.

    python benches/pages/results.py [--flap target/release/flap] [--steps 60]

The script requires the Debian packages chromium and chromium-driver, and the Python package selenium. A sweep of three
axes gives 126,000 rows, and `flap plot --html` makes a page of these rows. The page measures the time from opening the
page to the frame after the first picture. The page also measures the time from each step of a slider to the redrawn
picture. The script measures each kind of picture, and a picture with the lines of all slices.
"""

import argparse
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from live import browser
from selenium.webdriver.support.wait import WebDriverWait

GRID = """\
preset = "ozaki2018-large"
[axes]
drive_voltage_pp = { from = "40 V", to = "98 V", step = "2 V" }
drive_frequency = { from = "95 Hz", to = "136 Hz", step = "1 Hz" }
hinge_stiffness = { from = "60 uN*m/rad", to = "159 uN*m/rad", step = "1 uN*m/rad" }
[output]
columns = ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"]
"""
VIEWS = {
    "lines": ["--y", "lift_mean_mn"],
    "points": ["--kind", "scatter", "--x", "power_mean_mw", "--y", "lift_mean_mn", "--color", "hinge_stiffness"],
    "map": ["--color", "lift_mean_mn"],
}
ALL_SLICES = """
const begun = performance.now();
for (const menu of document.querySelectorAll("#slices select")) {
  if (menu.value === "") continue;
  menu.value = "";
  menu.dispatchEvent(new Event("change"));
}
requestAnimationFrame(() => arguments[0](performance.now() - begun));
"""


def measures(driver, name):
    """Return all measured times with the given name (ms)."""
    return driver.execute_script(
        "return performance.getEntriesByName(arguments[0]).map((entry) => entry.duration)", name
    )


def steps_of_a_slider(driver, steps):
    """Return the time of each picture (ms), while the lower bound of a filter rises."""
    driver.execute_script("document.querySelector('#add').click()")
    for step in range(steps):
        driver.execute_script(
            "const slider = document.querySelector('.filter input[type=range]');"
            "slider.value = arguments[0]; slider.oninput()",
            5 * (step + 1),
        )
        time.sleep(0.02)
    WebDriverWait(driver, 30).until(lambda _: len(measures(driver, "flap-filter-to-picture")) > 0)
    time.sleep(0.5)
    return measures(driver, "flap-filter-to-picture")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flap", default="target/release/flap", help="the command")
    parser.add_argument("--steps", type=int, default=60, help="steps of a slider")
    arguments = parser.parse_args()
    flap = Path(arguments.flap).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "large.toml").write_text(GRID, encoding="utf-8")
        subprocess.run([flap, "sweep", "large.toml", "--out", "large.csv", "--quiet"], cwd=folder, check=True)
        driver = browser()
        driver.set_script_timeout(120)
        try:
            print("view               first picture s  pictures  median ms  95th percentile ms")
            for view, wishes in VIEWS.items():
                page = folder / f"{view}.html"
                subprocess.run(
                    [flap, "plot", "large.csv", "--html", page, *wishes], cwd=folder, check=True, capture_output=True
                )
                driver.get(page.as_uri())
                WebDriverWait(driver, 60).until(lambda _: measures(driver, "flap-first-picture"))
                first = measures(driver, "flap-first-picture")[0] / 1000
                times = steps_of_a_slider(driver, arguments.steps)
                last = statistics.quantiles(times, n=20)[-1] if len(times) > 1 else times[0]
                print(
                    f"{view:17}  {first:15.2f}  {len(times):8}  {statistics.median(times):9.1f}  {last:18.1f}",
                    flush=True,
                )
                if view == "lines":
                    driver.execute_script("document.querySelector('#reset').click()")
                    taken = driver.execute_async_script(ALL_SLICES) / 1000
                    print(f"{'lines, all slices':17}  {taken:15.2f}", flush=True)
        finally:
            driver.quit()


if __name__ == "__main__":
    main()

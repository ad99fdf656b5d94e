"""Time from the motion of a slider to the redrawn coarse curves of the live page, in a headless browser.

    python benches/pages/live.py [--flap target/release/flap] [--steps 200]

The script requires the Debian packages chromium and chromium-driver, and the Python package selenium. For one preset of
each model, a slider is dragged with the mouse, 60 steps per second. The page measures the time from the slider's event
to the frame after the picture was drawn. Steps during a running request are shown by the next request. For the next
request, the time is measured from the first step during the running request.
"""

import argparse
import signal
import statistics
import subprocess
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.wait import WebDriverWait

PRESETS = {
    "jafferis2016": "hinge_stiffness",
    "ozaki2018-large": "hinge_stiffness",
    "arabagi2013-75hz": "wing_length",
}
AT_REST = "return window.flapTestHook?.isSettled() === true"
POINTS = "return flapTestHook.rows().request.x.n"
MEASURES = "return performance.getEntriesByName('flap-slider-to-picture').map((entry) => entry.duration)"


def browser():
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1600,1000"):
        options.add_argument(argument)
    return webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))


def drag(driver, name, steps):
    """Drag the slider of a parameter back and forth around the value of the parameter, one pixel per step. Return the
    duration of the motion of the slider (s), and the number of x values in a line at the end.
    """
    place = """
      const slider = document.querySelector(`[data-name="${arguments[0]}"] input[type=range]`);
      slider.closest("details").open = true;
      slider.scrollIntoView({ block: "nearest" });
      const { left, top, width, height } = slider.getBoundingClientRect();
      return [left, top, width, height];
    """
    left, top, width, height = driver.execute_script(place, name)
    middle, y, reach = round(left + width / 2), top + height / 2, round(width / 5)

    def mouse(kind, x):
        event = {"type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1}
        driver.execute_cdp_cmd("Input.dispatchMouseEvent", event)

    mouse("mousePressed", middle)
    begun = time.perf_counter()
    for step in range(steps):
        time.sleep(max(0.0, begun + step / 60 - time.perf_counter()))
        offset = step % (4 * reach)
        mouse(
            "mouseMoved",
            middle + (offset if offset <= reach else 2 * reach - offset if offset <= 3 * reach else offset - 4 * reach),
        )
    took = time.perf_counter() - begun
    # The last picture is coarse until the slider is released.
    points = driver.execute_script(POINTS)
    mouse("mouseReleased", middle)
    return took, points


def measured(driver, command, preset, name, steps):
    """Return the time of each picture (ms), the number of x values in a line at the end, and the number of steps per
    second."""
    server = subprocess.Popen(
        [command, "live", preset, "--no-open"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        driver.get(server.stdout.readline().strip())
        WebDriverWait(driver, 30).until(lambda _: driver.execute_script(AT_REST))
        drag(driver, name, 20)
        time.sleep(1)
        driver.execute_script("performance.clearMeasures()")
        took, points = drag(driver, name, steps)
        time.sleep(0.5)
        return driver.execute_script(MEASURES), points, steps / took
    finally:
        server.send_signal(signal.SIGTERM)
        server.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flap", default="target/release/flap", help="the command")
    parser.add_argument("--steps", type=int, default=200, help="steps of a slider")
    arguments = parser.parse_args()
    driver = browser()
    try:
        print("preset              pictures  points per line  steps/s  median ms  95th percentile ms")
        for preset, name in PRESETS.items():
            times, points, rate = measured(driver, arguments.flap, preset, name, arguments.steps)
            last = statistics.quantiles(times, n=20)[-1]
            print(
                f"{preset:18}  {len(times):8}  {points:15}  {rate:7.0f}  {statistics.median(times):9.1f}  {last:18.1f}"
            )
    finally:
        driver.quit()


if __name__ == "__main__":
    main()

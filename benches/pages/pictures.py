"""Pictures of the live page and of the page of results for the documentation, taken in a headless browser.

    python benches/pages/pictures.py [--flap target/release/flap] [FOLDER]

The script writes live.png (a wide window with light colours) and live-dark.png (the width of a tablet, with dark
colours). The script also writes cli-page.png (the page of results). The files are written to FOLDER. Default:
docs/pictures. The script requires the Debian packages chromium and chromium-driver, and the Python packages selenium
and pillow. The pictures have few colours, so that each is smaller than 60 kB.
"""

import argparse
import base64
import io
import signal
import subprocess
import tempfile
from pathlib import Path

from live import AT_REST, browser
from PIL import Image
from selenium.webdriver.support.wait import WebDriverWait

ROOT = Path(__file__).parents[2]
LARGEST = 60_000
# The distance of two colours that are kept, among red, green and blue from 0 to 255.
APART = 16

# A stiffer hinge than the published one, in its field.
STIFFER = """
const field = document.querySelector("#p-hinge_stiffness");
field.value = "1.6";
field.dispatchEvent(new Event("change"));
"""
DRAWN = """
return document.querySelectorAll("#series .u-over").length > 0
  && document.querySelectorAll("#gradient .slope").length > 0
  && flapTestHook.isSettled() && flapTestHook.charts[0].scene.lines.some(({ ghost }) => ghost);
"""
# A moment of the cycle at which stroke, pitch and forces are seen.
STILL = "flapTestHook.showMoment(0.18)"


def window(driver, width, height, scheme):
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})


def in_few_colours(picture, count):
    """Return a picture reduced to the most frequent colours, of which no two are similar."""
    kept = []
    for _, colour in sorted(picture.getcolors(picture.width * picture.height), reverse=True):
        if all(sum((a - b) ** 2 for a, b in zip(colour, other)) >= APART**2 for other in kept):
            kept.append(colour)
        if len(kept) == count:
            break
    palette = Image.new("P", (1, 1))
    palette.putpalette([part for colour in kept for part in colour])
    return picture.quantize(palette=palette, dither=Image.Dither.NONE)


def save(driver, path):
    """Save the window as a PNG file, with the largest number of colours that the limit of the file size allows."""
    driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
    shot = driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
    picture = Image.open(io.BytesIO(base64.b64decode(shot))).convert("RGB")
    for colours in (128, 64, 32, 24, 16):
        in_few_colours(picture, colours).save(path, optimize=True)
        if path.stat().st_size < LARGEST:
            print(f"{path.name}: {path.stat().st_size} bytes, {colours} colours")
            return
    raise SystemExit(f"{path.name} is too large")


def live(driver, flap, folder):
    """Save pictures of the live page of the bimorph, with a hinge that is stiffer than the published hinge."""
    arguments = [flap, "live", "jafferis2016", "--no-open"]
    server = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        address = server.stdout.readline().strip()
        for name, width, height, scheme in [("live", 1600, 780, "light"), ("live-dark", 820, 1180, "dark")]:
            window(driver, width, height, scheme)
            driver.get("about:blank")
            driver.get(address)
            wait = WebDriverWait(driver, 60)
            wait.until(lambda _: driver.execute_script(AT_REST))
            driver.execute_script(STIFFER)
            wait.until(lambda _: driver.execute_script(DRAWN))
            driver.execute_script(STILL)
            save(driver, folder / f"{name}.png")
    finally:
        server.send_signal(signal.SIGTERM)
        server.wait()


def results(driver, flap, folder):
    """Save a picture of the page of results in docs/how-to/plots.md, with one selected row."""
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        subprocess.run(
            [flap, "sweep", ROOT / "examples/ozaki_large.toml", "--out", "ozaki_large.csv", "--quiet"],
            cwd=place,
            check=True,
        )
        subprocess.run(
            [flap, "plot", "ozaki_large.csv", "--html", "ozaki_large.html"], cwd=place, check=True, capture_output=True
        )
        window(driver, 1300, 800, "light")
        driver.get((place / "ozaki_large.html").as_uri())
        WebDriverWait(driver, 60).until(
            lambda _: driver.execute_script("return window.flapTestHook?.charts[0].plot != null")
        )
        driver.execute_script("""
          const [first] = flapTestHook.charts, kind = document.querySelector("#kind");
          document.querySelector("#two").click();
          kind.value = "map";
          kind.dispatchEvent(new Event("change"));
          const line = first.scene.lines[5];
          first.options.onPin({ row: line.rows[13] });
        """)
        save(driver, folder / "cli-page.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--flap", default="target/release/flap", help="the command")
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "docs/pictures")
    arguments = parser.parse_args()
    flap = Path(arguments.flap).resolve()
    driver = browser()
    try:
        live(driver, flap, arguments.folder)
        results(driver, flap, arguments.folder)
    finally:
        driver.quit()


if __name__ == "__main__":
    main()

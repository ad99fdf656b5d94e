"""The search of the manual finds the right page first. MANUAL names the folder of the built site."""

import os
import shutil
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

# Words that users type, and the pages that may come first.
SEARCHES = {
    "install": ["start/install"],
    "resonance": ["how-to/resonance"],
    "hysteresis": ["how-to/response"],
    "fit": ["how-to/fit", "reference/python/generated/flapwing.fit"],
    "unsettled": ["reference/results", "how-to/questions", "models/numerics"],
    "parquet": ["reference/results", "how-to/questions"],
    "slurm": ["how-to/several-machines"],
    "dask": ["how-to/several-machines"],
    "submitit": ["how-to/several-machines"],
    "lustre": ["how-to/several-machines"],
    "outline": ["how-to/wings", "learn/1-wing"],
    "tolerance": ["how-to/studies", "learn/5-tolerance"],
    "units": ["reference/grid"],
    "derivative": ["how-to/derivatives"],
    "floquet": ["glossary", "models/numerics"],
    "matlab": ["how-to/questions", "how-to/hover"],
    "co-simulation": ["how-to/hover"],
    "torque": ["how-to/vehicle", "models/vehicle"],
    "transmission ratio": ["glossary"],
    "rtol": ["models/numerics", "glossary"],
    "sidecar": ["reference/results", "glossary"],
    "heatmap": ["reference/python/generated/flapwing.plot.heatmap"],
    "evaluate": ["reference/python/generated/flapwing.evaluate"],
    "cite": ["how-to/questions"],
    "wake capture": ["models/limits"],
    "cluster": ["how-to/several-machines", "learn/7-cluster"],
    "shard": ["how-to/several-machines", "glossary"],
    "no compiler": ["start/install"],
    "which model": ["how-to/questions"],
    "does not settle": ["how-to/questions"],
    "worst case": ["how-to/studies"],
    "two solutions": ["how-to/response"],
    "steering": ["how-to/vehicle"],
    "model-predictive control": ["how-to/vehicle"],
    "RoboBee": ["models/bimorph"],
    "precision": ["models/numerics"],
    "error bars": ["how-to/fit"],
    "job array": ["how-to/several-machines"],
    "notebook": ["start/index", "start/first-notebook"],
    "duty cycle": ["how-to/experiments"],
    "square wave": ["how-to/experiments"],
    "lift per power": ["how-to/questions", "how-to/devices", "models/bimorph"],
    "compare wings": ["how-to/devices"],
    "two strokes": ["how-to/response"],
    "bistable voltage": ["how-to/response"],
    "hysteresis voltage": ["how-to/response"],
    "fit damping": ["how-to/fit"],
    "missing effect": ["how-to/compare-laws"],
    "model selection": ["how-to/compare-laws"],
    "not modelled": ["models/limits"],
    "accuracy experiments": ["models/limits", "evidence/reproduction"],
    "hinge stiffness formula": ["models/terms"],
    "hinge width": ["models/terms"],
    "hinge thickness": ["how-to/questions", "models/terms"],
    "target value": ["how-to/optimise", "how-to/questions"],
    "supply power": ["how-to/questions", "models/bimorph"],
    "altitude": ["how-to/questions"],
    "air density": ["how-to/questions"],
    "pgfplots": ["how-to/plots"],
    "marker": ["how-to/wings"],
    "force sensor": ["how-to/experiments"],
    "oscilloscope": ["how-to/experiments"],
    "frame rate": ["how-to/experiments"],
}


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    chromium, driver = (shutil.which(name) for name in ("chromium", "chromedriver"))
    if chromium is None or driver is None:
        pytest.skip("chromium and chromedriver are not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    profile = tmp_path_factory.mktemp("browser")
    for option in ("--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}"):
        options.add_argument(option)
    started = webdriver.Chrome(options=options, service=Service(driver))
    yield started
    started.quit()


@pytest.mark.parametrize("words", SEARCHES)
def test_the_first_hit(words, browser):
    site = Path(os.environ["MANUAL"]).resolve()
    browser.get(f"{(site / 'search.html').as_uri()}?q={words.replace(' ', '+')}")
    WebDriverWait(browser, 20).until(
        lambda page: (
            "Search finished" in page.find_element(By.ID, "search-results").text
            or "did not match" in page.find_element(By.ID, "search-results").text
        )
    )
    hits = browser.find_elements(By.CSS_SELECTOR, "#search-results ul.search > li a")
    addresses = [hit.get_attribute("href").removeprefix(site.as_uri() + "/").split(".html")[0] for hit in hits]
    assert addresses and addresses[0] in SEARCHES[words], addresses[:5]

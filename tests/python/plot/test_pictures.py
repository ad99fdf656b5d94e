"""The pictures of the manual."""

import re
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).parents[3]


def test_pictures_are_shown_and_small():
    pages = [REPOSITORY / "README.md", *(REPOSITORY / "docs").rglob("*.md")]
    shown = {name for page in pages for name in re.findall(r"pictures/([\w.-]+)", page.read_text(encoding="utf-8"))}
    sizes = {path.name: path.stat().st_size for path in (REPOSITORY / "docs/pictures").iterdir()}
    assert shown == set(sizes)
    assert max(sizes.values()) < 80_000 and sum(sizes.values()) < 1_500_000


def test_the_pictures_of_python_are_made(tmp_path):
    """All of them and no others."""
    panels = tmp_path / "py-four-panels.png"
    for script, out in (("docs/site/pictures.py", tmp_path), ("examples/python/10_four_panels.py", panels)):
        command = [sys.executable, "-W", "error", REPOSITORY / script, out]
        subprocess.run(command, check=True, capture_output=True, text=True)
    kept = {picture.name for picture in (REPOSITORY / "docs/pictures").glob("py-*")}
    assert {picture.name for picture in tmp_path.iterdir()} == kept

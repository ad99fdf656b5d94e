"""The settings of the manual for Sphinx. `docs/site/build.py` prepares the sources and runs Sphinx on them."""

from pathlib import Path

import flapwing
from pygments.lexers.special import TextLexer

project = "flap"
author = "The flap developers"
copyright = "the flap developers"
version = release = flapwing.__version__

extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx-mathjax-offline",
]
exclude_patterns = ["style", "site", "**/files"]
myst_enable_extensions = ["dollarmath", "deflist", "attrs_inline", "colon_fence"]
myst_heading_anchors = 4
# Outputs are stored in the notebook; a test compares them.
nb_execution_mode = "off"
nb_merge_streams = True
# Options such as --out keep their hyphens.
smartquotes = False
# `Readings` in a docstring is a link.
default_role = "py:obj"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
copybutton_exclude = ".linenos, .gp, .go"
copybutton_selector = "div:not(.highlight-text) > div.highlight > pre"
suppress_warnings = ["myst.header", "mystnb.unknown_mime_type"]

html_theme = "pydata_sphinx_theme"
html_title = "flap"
html_static_path = ["site/static"]
html_css_files = ["manual.css"]
html_show_sourcelink = False
html_copy_source = False
html_search_language = "en"
html_search_scorer = str(Path(__file__).parent / "site/scorer.js")
html_theme_options = {
    "navbar_align": "left",
    "header_links_before_dropdown": 8,
    "show_prev_next": True,
    "show_toc_level": 2,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
}
pygments_style = "tango"


def setup(app):
    app.add_lexer("csv", TextLexer)

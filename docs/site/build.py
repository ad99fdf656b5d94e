"""Builds the manual: pages of docs/, documents at the top of the repository, and the generated reference.

    python docs/site/build.py FLAP OUT [--rust FOLDER]

FLAP is the command `flap`, whose help and tables become the reference. OUT gets `source` and `html`. `--rust` names the
folder with the documentation of the crates, which is copied into the site. The package flapwing must be importable.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import reference

REPOSITORY = Path(__file__).parents[2]

# Documents outside of docs/, by their pages in the site.
DOCUMENTS = {
    "ARCHITECTURE.md": "contributing/architecture.md",
    "CONTRIBUTING.md": "contributing/guide.md",
    "CHANGELOG.md": "contributing/changelog.md",
    "SUPPORT.md": "contributing/support.md",
    "SECURITY.md": "contributing/security.md",
    "CODE_OF_CONDUCT.md": "contributing/conduct.md",
    "tests/README.md": "contributing/tests.md",
    "tests/data/README.md": "contributing/reference-data.md",
    "benches/peers/README.md": "evidence/peers.md",
    "examples/README.md": "examples/index.md",
    "examples/own_model/README.md": "examples/own_model.md",
}
# Pages that only links lead to.
APART = ["examples/own_model.md"]
LANGUAGES = {
    ".bib": "bibtex",
    ".cff": "yaml",
    ".toml": "toml",
    ".py": "python",
    ".rs": "rust",
    ".sh": "sh",
    ".csv": "text",
}
LINK = re.compile(r"(\]\()([^)#\s]+)(#[^)\s]*)?\)")
FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
# Words that lead to a page in the search.
KEYWORDS = re.compile(r"^<!-- keywords: (.*?) -->$", re.MULTILINE)
# Comments that only the tests read.
HIDDEN = re.compile(r"^<!-- (?:setup|check|not run).*?-->\n", re.MULTILINE | re.DOTALL)


class Sources:
    """The pages of the site, with links that lead to pages of the site."""

    def __init__(self, source: Path) -> None:
        self.source = source
        self.missing: list[str] = []
        # Pages of files that others link to, such as examples.
        self.files: dict[str, str] = {}

    def page_of(self, path: str) -> str | None:
        """The page for a path in the repository."""
        if path in DOCUMENTS:
            return DOCUMENTS[path]
        if path == "README.md":
            return "index.md"
        if path.startswith("docs/"):
            return path.removeprefix("docs/")
        if path.startswith("examples") and (REPOSITORY / path).is_dir():
            return "examples/index.md"
        if (REPOSITORY / path).is_file() and Path(path).suffix in LANGUAGES:
            page = f"files/{path}.md"
            self.files[path] = page
            return page
        return None

    def add(self, path: str, page: str) -> None:
        """Writes the document at `path` of the repository as `page`."""
        text = HIDDEN.sub("", (REPOSITORY / path).read_text(encoding="utf-8"))

        def relinked(found: re.Match[str]) -> str:
            start, target, anchor = found[1], found[2], found[3] or ""
            if "://" in target or target.startswith("mailto:"):
                return found[0]
            other = os.path.normpath(os.path.join(os.path.dirname(path), target))
            linked = self.page_of(other)
            if linked is None:
                self.missing.append(f"{path}: {target}")
                return found[0]
            return f"{start}{os.path.relpath(linked, os.path.dirname(page) or '.')}{anchor})"

        text = KEYWORDS.sub(lambda found: indexed(found[1]), text)
        if page in APART:
            text = f"---\norphan: true\n---\n\n{text}"
        parts = FENCED.split(text)
        parts[::2] = [LINK.sub(relinked, part) for part in parts[::2]]
        self.write(page, "".join(parts))

    def write(self, page: str, text: str) -> None:
        path = self.source / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def add_files(self) -> None:
        """A page for each file that others link to."""
        for path, page in sorted(self.files.items()):
            body = (REPOSITORY / path).read_text(encoding="utf-8")
            fence = "`" * 4
            text = f"---\norphan: true\n---\n\n# {path}\n\n{fence}{LANGUAGES[Path(path).suffix]}\n{body}{fence}\n"
            self.write(page, text)


def indexed(keywords: str) -> str:
    """The directive that makes main entries of the index, which the search ranks first."""
    return "```{index} " + ", ".join(f"! {keyword.strip()}" for keyword in keywords.split(",")) + "\n```"


def main() -> int:
    parser = argparse.ArgumentParser(description="Builds the manual.")
    parser.add_argument("flap", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--rust", type=Path)
    arguments = parser.parse_args()
    source, html = arguments.out / "source", arguments.out / "html"
    shutil.rmtree(source, ignore_errors=True)
    shutil.rmtree(html, ignore_errors=True)
    others = shutil.ignore_patterns("*.md", "*.ipynb", "style", "__pycache__")
    shutil.copytree(REPOSITORY / "docs", source, ignore=others)

    sources = Sources(source)
    docs = REPOSITORY / "docs"
    for page in sorted([*docs.rglob("*.md"), *docs.rglob("*.ipynb")]):
        path = page.relative_to(REPOSITORY).as_posix()
        sources.add(path, path.removeprefix("docs/"))
    for path, page in DOCUMENTS.items():
        if (REPOSITORY / path).is_file():
            sources.add(path, page)
    sources.add_files()
    for page, text in reference.pages(arguments.flap).items():
        sources.write(page, text)
    if sources.missing:
        print("links to files without a page:", *sources.missing, sep="\n  ", file=sys.stderr)
        return 1

    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    ended = subprocess.run([*command, source, html], check=False)
    if ended.returncode == 0 and arguments.rust:
        shutil.copytree(arguments.rust, html / "rust", dirs_exist_ok=True)
    return ended.returncode


if __name__ == "__main__":
    sys.exit(main())

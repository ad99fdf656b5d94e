"""A page of the manual, run as a reader runs it.

| block | what happens |
|---|---|
| any language, below a line such as "`grid.toml`:" | saved as that file before the first command |
| `sh` | run by a shell that stops at the first error; lines that install something or start `flap live` are left out |
| `python` | executed; all blocks of a page share their names |
| `text`, directly after `sh` or `python` | part of what the block printed; a line `...` stands for any lines |
| `console` and other languages | not run |
| `toml` without a file name that begins with `preset` or `device` | a grid that `flap check` accepts |

Comments in a page, which readers do not see, prepare and check it:

    <!-- setup
    lines for the shell
    -->
    <!-- check
    assert column("wing.csv", "stroke_pp_deg")[0] < 110  # in Python, with the names of the page
    -->
    <!-- not run: the reason -->    the next block is only shown

A block may fail if the `text` after it shows the error.

If the output of many pages changes, RENEW_PAGES=1 writes the new output into the pages. Read the changes before you
commit them.
"""

from __future__ import annotations

import contextlib
import difflib
import io
import os
import re
import subprocess
import traceback
import warnings
from dataclasses import dataclass
from pathlib import Path

import flapwing

REPOSITORY = Path(__file__).parents[2]
LEFT_OUT = ("cargo ", "git clone", "python3 -m venv", "pip install", "./scripts/", "flap live")
BLOCK = re.compile(
    r"^(?P<fence>```+|:::+)(?P<language>[\w-]*)[^\n]*\n(?P<body>.*?)^(?P=fence)$"
    r"|^<!-- (?P<kind>setup|check|not run)(?P<text>.*?)-->$",
    re.MULTILINE | re.DOTALL,
)
NAMED = re.compile(r"^`([\w./-]+)`:\n\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def pages() -> list[str]:
    """All pages with blocks that run, by their paths in the repository."""
    found = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").rglob("*.md"))]
    found += sorted((REPOSITORY / "crates").glob("*/README.md")) + sorted((REPOSITORY / "examples").rglob("README.md"))
    runs = {"sh", "python", "toml", "setup", "check"}
    return [
        page.relative_to(REPOSITORY).as_posix()
        for page in found
        if any(block["language"] in runs or block["kind"] in runs for block in BLOCK.finditer(text_of(page)))
    ]


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def python_blocks(page: str) -> list[str]:
    """The code in Python that a reader sees."""
    return [block["body"] for block in BLOCK.finditer(text_of(REPOSITORY / page)) if block["language"] == "python"]


@dataclass
class Page:
    """A page that runs in `folder` with the command `flap`."""

    name: str
    folder: Path
    flap: Path

    def run(self) -> None:
        text = text_of(REPOSITORY / self.name)
        (self.folder / "examples").symlink_to(REPOSITORY / "examples")
        files = NAMED.findall(text)
        for name, body in files:
            path = self.folder / name
            assert not path.exists(), f"{self.name} shows {name} twice"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(body, encoding="utf-8")
        self.names: dict[str, object] = {"column": self.column, "shell": self.shell, "page": text}
        printed, error, place = "", None, ""
        shown_only = False
        for block in BLOCK.finditer(text):
            language, body = block["kind"] or block["language"], block["text"] or block["body"]
            if language == "text" and place and not shown_only:
                if "RENEW_PAGES" in os.environ and not shows(printed, body):
                    path = REPOSITORY / self.name
                    path.write_text(text_of(path).replace(body, renewed(printed, body)), encoding="utf-8")
                    body = renewed(printed, body)
                assert shows(printed, body), f"{place} printed\n{end(printed)}\nnot\n{body}"
                error = None
            assert error is None, f"{place}: {error}\n{end(printed)}"
            place = f"{self.name}:{text.count(chr(10), 0, block.start()) + 1}"
            if shown_only or language == "not run":
                shown_only = language == "not run"
                place = ""
            elif language == "setup":
                self.lines(body)
            elif language == "sh":
                printed, error = self.attempt(lambda lines=body: self.lines(lines))
            elif language in ("python", "check"):
                # Padded, so that tracebacks have the lines of the page.
                padded = "\n" * text.count("\n", 0, block.start("text" if language == "check" else "body")) + body
                printed, error = self.attempt(lambda code=padded: self.execute(code))
                self.names["printed"] = printed
            else:
                if (
                    language == "toml"
                    and body.startswith(("preset", "device"))
                    and body not in [named for _, named in files]
                ):
                    self.accepts(body)
                place = ""
        assert error is None, f"{place}: {error}\n{end(printed)}"

    def attempt(self, run) -> tuple[str, Exception | None]:
        """Call `run`, and return its printed output and its exception."""
        output = io.StringIO()
        error = None
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output), warnings.catch_warnings():
            warnings.simplefilter("default")
            try:
                run()
            except Exception as failed:
                error = failed
                if not isinstance(failed, ShellError):
                    output.write("".join(traceback.format_exception_only(failed)))
        return output.getvalue(), error

    def execute(self, code: str) -> None:
        exec(compile(code, self.name, "exec"), self.names)

    def lines(self, lines: str) -> None:
        """Prints the output and the errors of `lines`. Raises if a line fails."""
        # In a pipeline, errors of the first command can appear at any place in the output of the last command.
        ended = self.ran(lines, errors=subprocess.PIPE if " | " in lines else subprocess.STDOUT)
        print(ended.stdout, ended.stderr or "", sep="", end="")
        if ended.returncode:
            raise ShellError(f"exit code {ended.returncode} of\n{lines}")

    def shell(self, lines: str) -> str:
        """The standard output of `lines`. Raises if a line fails."""
        ended = self.ran(lines, errors=subprocess.PIPE)
        if ended.returncode:
            raise ShellError(f"exit code {ended.returncode} of\n{lines}\n{ended.stderr}")
        return ended.stdout

    def ran(self, lines: str, errors: int) -> subprocess.CompletedProcess[str]:
        kept = "\n".join(line for line in lines.splitlines() if not line.startswith(LEFT_OUT))
        environment = {key: value for key, value in os.environ.items() if key != "COLUMNS"}
        environment["PATH"] = f"{self.flap.parent}:{environment['PATH']}"
        return subprocess.run(
            ["sh", "-ec", kept],
            cwd=self.folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
        )

    def accepts(self, grid: str) -> None:
        """Checks a grid in a file of its own, beside the page's other files."""
        path = self.folder / "_block.toml"
        path.write_text(grid, encoding="utf-8")
        self.shell("flap check _block.toml")
        path.unlink()

    def column(self, results: str, name: str):
        """A column of results as a NumPy array."""
        return flapwing.read(self.folder / results)[name]


class ShellError(Exception):
    """A line in the shell failed."""


def end(printed: str) -> str:
    return "\n".join(printed.splitlines()[-40:])


def renewed(printed: str, shown: str) -> str:
    """`shown` with each line replaced by the printed line that is most like it, in order."""
    rest = printed.splitlines()
    lines = []
    for line in shown.splitlines():
        if line != "..." and rest:
            similar = [difflib.SequenceMatcher(None, line, other).ratio() for other in rest]
            place = similar.index(max(similar))
            line, rest = rest[place].rstrip(), rest[place + 1 :]
        lines.append(line)
    return "\n".join(lines) + "\n"


def shows(printed: str, shown: str) -> bool:
    """Return True if `printed` contains the lines `shown`. A line `...` stands for any lines; blanks at line ends do not count."""
    lines = [line.rstrip() for line in shown.splitlines()]
    parts = [r"(?:.*\n)*?" if line == "..." else re.escape(line) + r" *\n" for line in lines]
    return re.search("^" + "".join(parts), printed.rstrip("\n") + "\n", re.MULTILINE) is not None

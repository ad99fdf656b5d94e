"""The reference pages of the manual, generated from the command `flap` and the package `flapwing`."""

from __future__ import annotations

import importlib
import itertools
import json
import re
import subprocess
from pathlib import Path

MODULES = {
    "flapwing": "Sweeps, single points, experiments, tables and fits.",
    "flapwing.plot": "Pictures with matplotlib.",
    "flapwing.fitting": "The parts of a fit and its results.",
    "flapwing.analysis": "Numbers that pictures show, without matplotlib.",
}
SECTION = re.compile(r"^(\S[^\n]*):$")
ENTRY = re.compile(r"^ {2,6}(-\S.*?|\[?<?[A-Z][\w|<>\[\]./ -]*?\]?(?:\.\.\.)?)(?: {2,}(\S.*))?$")


# The guides of each command: pages of the manual.
GUIDES = {
    "sweep": ["start/first-sweep"],
    "run": ["how-to/devices", "how-to/experiments"],
    "respond": ["how-to/response"],
    "optimise": ["how-to/optimise"],
    "vehicle": ["how-to/vehicle"],
    "live": ["how-to/live"],
    "check": ["reference/grid"],
    "top": ["reference/results"],
    "describe": ["how-to/studies"],
    "plot": ["how-to/plots"],
    "results": ["reference/results"],
    "test": ["how-to/experiments"],
    "device": ["how-to/devices"],
    "models": ["how-to/terminal"],
    "generate": ["how-to/terminal"],
}
DOCS = Path(__file__).parents[1]


def pages(flap: Path) -> dict[str, str]:
    """The pages by their paths in the manual."""
    found = dict(command_pages(flap))
    found.update(model_pages(flap))
    found.update(python_pages())
    return found


def run(flap: Path, *arguments: str) -> str:
    ended = subprocess.run([flap, *arguments], capture_output=True, text=True, check=True)
    return ended.stdout


# Commands


def command_pages(flap: Path):
    """A page for each command, with its subcommands, and a list of them."""
    top = run(flap, "--help")
    groups = [
        (title, subcommands(body))
        for title, body in sections(top)
        if title not in ("Options", "Exit codes", "Usage", "") and subcommands(body)
    ]
    index = ["# Commands", "", "`flap help COMMAND` prints these texts in a terminal.", ""]
    names = []
    for title, commands in groups:
        index += [f"## {title}", "", "| command | task |", "|---|---|"]
        for name, summary in commands:
            if name == "help":
                continue
            names.append(name)
            index.append(f"| [`flap {name}`]({name}.md) | {cell(summary)} |")
        index.append("")
    codes = next((body for title, body in sections(top) if title == "Exit codes"), "")
    index += ["## Exit codes", "", "```text", *codes.strip("\n").splitlines(), "```", ""]
    index += ["```{toctree}", ":hidden:", "", *names, "```", ""]
    yield "reference/commands/index.md", "\n".join(index)
    for name in names:
        text = command(flap, [name], 1)
        if guides := GUIDES.get(name):
            head, _, rest = text.partition("\n\n")
            links = ", ".join(f"[{page_title(guide)}](../../{guide}.md)" for guide in guides)
            text = f"{head}\n\n{'Guide' if len(guides) == 1 else 'Guides'}: {links}.\n\n{rest}"
        for group, body in sections(run(flap, name, "--help")):
            if group == "Commands":
                for inner, _ in subcommands(body):
                    if inner != "help":
                        text += "\n" + command(flap, [name, inner], 2)
        yield f"reference/commands/{name}.md", text


def page_title(page: str) -> str:
    """The title of a page of the manual."""
    lines = (DOCS / f"{page}.md").read_text(encoding="utf-8").splitlines()
    return next(line.removeprefix("# ") for line in lines if line.startswith("# "))


def sections(text: str) -> list[tuple[str, str]]:
    """The parts of a help text: each title that ends with a colon, and the lines below it."""
    found = [("", [])]
    for line in text.splitlines():
        if title := SECTION.match(line):
            found.append((title[1], []))
        elif line and not line.startswith(" ") and found[-1][0]:
            found.append(("", [line]))
        else:
            found[-1][1].append(line)
    return [(title, "\n".join(lines)) for title, lines in found]


def subcommands(body: str) -> list[tuple[str, str]]:
    """Names and summaries of the commands that a section lists."""
    joined = re.sub(r"\n {8,}", " ", body)
    return re.findall(r"^  ([a-z]+) {2,}(\S.*)$", joined, re.MULTILINE)


def command(flap: Path, name: list[str], level: int) -> str:
    """The help of a command as Markdown."""
    title = "flap " + " ".join(name)
    text = [f"{'#' * level} {title}", ""]
    mark = "#" * (level + 1)
    for heading, body in sections(run(flap, *name, "--help")):
        lines = body.strip("\n")
        if heading.startswith("Usage") or lines.startswith("Usage: "):
            text += ["```text", lines, "```", ""]
        elif heading in ("Examples", "Example"):
            text += [f"{mark} Examples", "", "```sh", *(line[2:] for line in lines.splitlines()), "```", ""]
        elif heading == "Commands":
            continue
        elif heading and ENTRY.match(lines.splitlines()[0] if lines else ""):
            text += [f"{mark} {heading}", "", *entries(lines), ""]
        elif heading:
            text += [f"{mark} {heading}", "", "```text", lines, "```", ""]
        else:
            text += prose(lines)
    return "\n".join(text)


def prose(lines: str) -> list[str]:
    """Paragraphs outside of sections; the usage line becomes a block."""
    text = []
    for paragraph in re.split(r"\n\s*\n", lines):
        if paragraph.startswith("Example: "):
            continue
        if paragraph.startswith("Usage: "):
            text += ["```text", paragraph.removeprefix("Usage: "), "```", ""]
        elif any(line.startswith("  ") for line in paragraph.splitlines()):
            text += ["```text", paragraph, "```", ""]
        elif paragraph.strip():
            text += [escaped(" ".join(paragraph.split())), ""]
    return text


def entries(lines: str) -> list[str]:
    """Arguments and options as a list of definitions."""
    text = []
    for entry in re.split(r"^(?= {2,6}[-\[<A-Z])", lines, flags=re.MULTILINE):
        if not (found := ENTRY.match(entry.split("\n")[0])):
            continue
        paragraphs = re.split(r"\n\s*\n", (found[2] or "") + "\n" + "\n".join(entry.split("\n")[1:]))
        body = []
        for paragraph in paragraphs:
            words = paragraph.split("\n")
            if words[0].strip() == "Possible values:":
                body += ["Possible values:", ""]
                for value in re.split(r"\n\s*- ", "\n" + "\n".join(words[1:]))[1:]:
                    name, _, meaning = " ".join(value.split()).partition(": ")
                    body.append(f"- `{name.rstrip(':')}`" + (f": {escaped(meaning)}" if meaning else ""))
                body.append("")
            elif paragraph.strip():
                body += [escaped(" ".join(paragraph.split())), ""]
        text += ["", f"`{found[1]}`", f": {body[0] if body else ''}", *(f"  {line}".rstrip() for line in body[1:])]
    return text


def escaped(text: str) -> str:
    """Text without marks that Markdown would take for its own."""
    parts = re.split(r"(`[^`]*`)", text)
    parts[::2] = [re.sub(r"([<>*_\[\]$|])", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def cell(text: object) -> str:
    return escaped("" if text is None else str(text)).replace("\n", " ")


# Parameters and columns


def model_pages(flap: Path):
    """For each model a page of its parameters with the values of its presets, and a page of its columns."""
    listed = json.loads(run(flap, "models", "--format", "json"))
    for model in (entry for entry in listed if entry["kind"] == "model"):
        presets = [entry for entry in listed if entry["kind"] == "preset" and entry["model"] == model["name"]]
        tables = [json.loads(run(flap, "models", preset["name"], "--format", "json")) for preset in presets]
        names = [preset["name"] for preset in presets]
        yield f"reference/parameters-{model['name']}.md", parameters(model, presets, names, tables)
        yield f"reference/columns-{model['name']}.md", columns(model, tables[0])


def parameters(model: dict, presets: list[dict], names: list[str], tables: list[list[dict]]) -> str:
    text = [f"# Parameters of {model['name']}", "", f"{model['meaning'][0].upper()}{model['meaning'][1:]}.", ""]
    text += ["| preset | design |", "|---|---|"]
    text += [f"| `{preset['name']}` | {cell(preset['meaning'])} |" for preset in presets]
    text += ["", "Values are in SI units. In a grid file, write them with any unit of their dimension.", ""]
    rows = [entry for entry in tables[0] if entry["kind"] == "parameter"]
    values = [{entry["name"]: entry["value"] for entry in table} for table in tables]
    for group, members in itertools.groupby(rows, key=lambda entry: entry["group"]):
        text += [f"## {group.capitalize()}", "", "::::{div} reference-table"]
        text += ["| parameter | meaning | unit | " + " | ".join(f"`{name}`" for name in names) + " | allowed |"]
        text += ["|---" * (len(names) + 4) + "|"]
        for entry in members:
            shown = [number(table[entry["name"]]) for table in values]
            meaning = cell(entry["meaning"]) + (f" Symbol: {cell(entry['symbol'])}." if entry["symbol"] else "")
            cells = [f"`{entry['name']}`", meaning, cell(entry["unit"]), *shown, cell(entry["allowed"])]
            text.append("| " + " | ".join(cells) + " |")
        text += ["::::", ""]
    return "\n".join(text)


def columns(model: dict, table: list[dict]) -> str:
    text = [f"# Columns of {model['name']}", "", f"The columns of rows of the model `{model['name']}`.", ""]
    rows = [entry for entry in table if entry["kind"] != "parameter"]
    for group, members in itertools.groupby(rows, key=lambda entry: entry["group"]):
        text += [f"## {group[0].upper()}{group[1:]}", "", "::::{div} reference-table"]
        text += ["| column | meaning | unit |", "|---|---|---|"]
        text += [f"| `{entry['name']}` | {cell(entry['meaning'])} | {cell(entry['unit'])} |" for entry in members]
        text += ["::::", ""]
    return "\n".join(text)


def number(value: object) -> str:
    if value is None:
        return "–"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


# Python


def python_pages():
    """A list of the public names of each module; Sphinx writes a page for each name from its docstring."""
    described: set[int] = set()
    for module, summary in MODULES.items():
        public = {
            name: getattr(importlib.import_module(module), name) for name in importlib.import_module(module).__all__
        }
        names = [name for name, thing in public.items() if name != "__version__" and id(thing) not in described]
        described.update(map(id, public.values()))
        text = [f"# {module}", "", summary, "", "```{eval-rst}", f".. currentmodule:: {module}", ""]
        text += [".. autosummary::", "   :toctree: generated", "", *(f"   {name}" for name in names), "```", ""]
        yield f"reference/python/{module}.md", "\n".join(text)
    index = [
        "# Python",
        "",
        "The package `flapwing`, from its docstrings.",
        "",
        "```{toctree}",
        "",
        *MODULES,
        "```",
        "",
    ]
    yield "reference/python/index.md", "\n".join(index)

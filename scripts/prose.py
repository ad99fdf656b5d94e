#!/usr/bin/env python3
"""Copy doc comments and docstrings into Markdown files, so that vale can check their sentences.

    python3 scripts/prose.py FOLDER FILE...
    cd FOLDER && vale --config REPOSITORY/.vale.ini --output=line .

For each .rs or .py file, FOLDER gets a file of the same path with the ending .md.
Its line numbers are the line numbers of the source.
Code lines, code blocks and doctests are blank in the copy.
Give paths that are relative to the current folder.
"""

import ast
import re
import sys
from pathlib import Path


def doc_comments(source: str) -> list[str]:
    """Text of `///` and `//!` comments by line of `source`, with blank lines for code."""
    lines = []
    in_code = False
    for line in source.splitlines():
        comment = re.match(r"\s*//[/!](?!/) ?(.*)", line)
        text = comment[1] if comment else ""
        is_fence = text.lstrip().startswith("```")
        lines.append("" if in_code or is_fence else text)
        in_code = bool(comment) and in_code != is_fence
    return lines


def docstrings(source: str) -> list[str]:
    """Text of docstrings by line of `source`, with blank lines for code and doctests."""
    lines = [""] * len(source.splitlines())
    for node in ast.walk(ast.parse(source)):
        body = getattr(node, "body", None)
        if not isinstance(body, list) or not body or not isinstance(body[0], ast.Expr):
            continue
        string = body[0].value
        if not isinstance(string, ast.Constant) or not isinstance(string.value, str):
            continue
        for number, text in enumerate(prose(string.value.splitlines()), string.lineno - 1):
            if number < string.end_lineno:
                lines[number] = text
    return lines


def prose(lines: list[str]) -> list[str]:
    """Lines of a docstring without doctests, code blocks, underlines and the lines `name : type` of numpydoc."""
    kept = []
    in_doctest = in_code = False
    # The indentation above a literal block, which follows a line with two colons at its end.
    literal: int | None = None
    for line in lines:
        text = line.strip()
        is_fence = text.startswith("```")
        in_doctest = text.startswith(">>>") or (in_doctest and text != "")
        is_layout = re.fullmatch(r"-{3,}|[*\w, ]+ : .*", text) is not None
        if text and literal is not None and len(line) - len(line.lstrip()) <= literal:
            literal = None
        is_code = in_doctest or in_code or is_fence or is_layout or literal is not None
        # A semicolon separates the entries of a list, such as the reasons of an error.
        kept.append("" if is_code else text.replace("; ", ". "))
        in_code = in_code != is_fence
        if text.endswith("::"):
            literal = len(line) - len(line.lstrip())
    return kept


def main(folder: str, paths: list[str]) -> None:
    readers = {".rs": doc_comments, ".py": docstrings}
    for path in map(Path, paths):
        copy = Path(folder, f"{path}.md")
        copy.parent.mkdir(parents=True, exist_ok=True)
        lines = readers[path.suffix](path.read_text(encoding="utf-8"))
        copy.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])

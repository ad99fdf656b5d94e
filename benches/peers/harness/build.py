"""The builds of peers in the folder target/peers. If a peer cannot be built, a message gives the reason."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

PEERS = Path(__file__).resolve().parents[1]
REPOSITORY = PEERS.parents[1]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR") or REPOSITORY / "target").resolve()
WORK = TARGET / "peers"

#: The help in the message for a missing compiler.
GXX = "install g++ (Debian: sudo apt-get install g++)"
BOOST = "install g++ and Boost's headers (Debian: sudo apt-get install g++ libboost-dev)"

#: Packages that several peers need.
NUMPY = "numpy==2.4.6"
SCIPY = "scipy==1.17.1"
NUMBA = "numba==0.68.1"


class Unavailable(Exception):
    """The error for a peer that cannot be built, with the reason and with help."""

    def __init__(self, why: str, remedy: str) -> None:
        super().__init__(why)
        self.why = why
        self.remedy = remedy


def need(program: str, remedy: str) -> None:
    """Raise Unavailable if the program `program` is missing."""
    if shutil.which(program) is None:
        raise Unavailable(f"there is no {program}", remedy)


def run(command: Sequence[object], remedy: str, cwd: Path | None = None) -> None:
    """Run a command of a build."""
    ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, cwd=cwd)
    if ended.returncode != 0:
        said = [line.strip() for line in ended.stderr.splitlines() if line.strip()]
        worst = next((line for line in said if "error" in line.lower()), said[-1] if said else "it says nothing")
        raise Unavailable(f"{Path(str(command[0])).name} failed: {worst}", remedy)


@dataclass(frozen=True)
class Cpp:
    """A peer in C++."""

    source: str
    flags: tuple[str, ...]
    remedy: str

    def build(self) -> list[str]:
        compiler = os.environ.get("CXX", "g++")
        need(compiler, self.remedy)
        source = PEERS / "cpp" / self.source
        program = WORK / "bin" / source.stem
        inputs = [*source.parent.iterdir(), *Path(__file__).parent.glob("*.py")]
        if not program.exists() or program.stat().st_mtime < max(path.stat().st_mtime for path in inputs):
            program.parent.mkdir(exist_ok=True)
            run([compiler, "-std=c++17", *self.flags, source, "-o", program], self.remedy)
        return [str(program)]


def processor_flag(level: str) -> str:
    """Return the compiler's flag for the instructions of a processor level such as x86-64-v3."""
    return f"-march={level}" if platform.machine() in ("x86_64", "AMD64") else "-mcpu=native"


@dataclass(frozen=True)
class Cargo:
    """A peer in Rust: the folder of the package, the arguments of cargo, and the path of the built program."""

    folder: Path
    arguments: tuple[str, ...]
    program: Path

    def build(self) -> list[str]:
        remedy = "install Rust by rustup, and let cargo reach crates.io"
        need("cargo", remedy)
        run(["cargo", "build", "--release", "--locked", *self.arguments], remedy, cwd=self.folder)
        return [str(self.program)]


@dataclass(frozen=True)
class Python:
    """A peer in Python: a script. All scripts share the packages of one virtual environment."""

    script: str
    packages: tuple[str, ...]

    def build(self) -> list[str]:
        environment = WORK / "venv"
        python = environment / "bin" / "python"
        if not python.exists():
            try:
                run([sys.executable, "-m", "venv", environment], "install Python's venv (Debian: python3-venv)")
            except Unavailable:
                shutil.rmtree(environment, ignore_errors=True)
                raise
        install = f"pip must reach a package index that has {' '.join(self.packages)} for this Python"
        run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *self.packages], install)
        return [str(python), str(PEERS / "python" / self.script)]


@dataclass(frozen=True)
class Through:
    """A program in Rust with different arguments than a peer. A Python script, which requires only the standard
    library, runs the program."""

    script: str
    program: Cargo
    #: Further arguments of the script, after the path of the program.
    arguments: tuple[str, ...]

    def build(self) -> list[str]:
        return [sys.executable, str(PEERS / "python" / self.script), *self.program.build(), *self.arguments]

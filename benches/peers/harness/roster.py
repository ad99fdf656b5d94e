"""Who takes part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from .build import PEERS, REPOSITORY, TARGET, WORK, Cargo, Cpp, Python, processor_flag

BOOST = "install g++ and Boost's headers (Debian: sudo apt-get install g++ libboost-dev)"
NUMPY = "numpy==2.4.6"


class Builder(Protocol):
    """A peer that can be built into a command."""

    def build(self) -> list[str]: ...


@dataclass(frozen=True)
class Peer:
    """A program that takes POINTS RTOL OUT."""

    name: str
    what: str
    builder: Builder
    #: True if it measures by 64 samples a period, as users of libraries do; else it finds peaks and means exactly.
    samples: bool = True
    #: True if it chooses its steps by the error.
    adaptive: bool = True
    #: Points that it gets at most, so that slow peers end.
    most_points: int | None = None


#: The peer that the others are compared with, and the one that gives the errors of all.
BASE = Peer(
    "boost",
    "Boost.Odeint (C++), DP5(4), dense output",
    # Its fastest build: with AVX-512 it is slower.
    Cpp("boost_dense.cpp", ("-O3", processor_flag("x86-64-v3")), BOOST),
)
REFERENCE = Cpp("reference.cpp", ("-O2",), BOOST)

PEERS_IN_TURN: tuple[Peer, ...] = (
    BASE,
    Peer(
        "flap",
        "examples/own_equations, DP5(4) in lanes",
        Cargo(REPOSITORY, ("-p", "flap-core", "--example", "own_equations"), TARGET / "release" / "examples" / "own_equations"),
        samples=False,
    ),
    Peer(
        "ode_solvers",
        "the Rust crate, DP5(4), dense output",
        # Built for the processor at hand it is no faster.
        Cargo(PEERS / "rust", ("--target-dir", str(WORK / "rust")), WORK / "rust" / "release" / "flap-peer"),
    ),
    Peer("cyrk", "CyRK (Python, C++), RK45", Python("cyrk_rk45.py", (NUMPY, "numba==0.68.1", "CyRK==0.20.0"))),
    Peer(
        "heyoka",
        "heyoka (Python, LLVM), Taylor in lanes, kinks as events",
        Python("heyoka_taylor.py", (NUMPY, "heyoka==7.13.2")),
    ),
    Peer(
        "scipy",
        "SciPy solve_ivp, RK45, plain Python",
        Python("scipy_rk45.py", (NUMPY, "scipy==1.17.1")),
        most_points=8,
    ),
    Peer(
        "numba_rk4",
        "RK4 by hand (Python, numba)",
        Python("numba_rk4.py", (NUMPY, "numba==0.68.1")),
        adaptive=False,
    ),
    Peer(
        "rk4_lanes",
        "RK4 by hand in lanes (C++): an upper mark",
        Cpp(
            "rk4_lanes.cpp",
            ("-O3", processor_flag("native"), "-ffast-math", "-fopenmp-simd", "-mprefer-vector-width=512"),
            "install g++ (Debian: sudo apt-get install g++)",
        ),
        adaptive=False,
    ),
)

"""The benchmark `integration`: forty drive periods from rest, with the equations of examples/own_equations."""

from __future__ import annotations

from .build import BOOST, GXX, NUMBA, NUMPY, PEERS, REPOSITORY, SCIPY, TARGET, WORK, Cargo, Cpp, Python, processor_flag
from .peer import Peer
from .work import Axis, Measure, Work

BASE = Peer(
    "boost",
    "Boost.Odeint in C++: Dormand-Prince 5(4) with dense output",
    # Its fastest build: with AVX-512 it is slower.
    Cpp("boost_dense.cpp", ("-O3", processor_flag("x86-64-v3")), BOOST),
)

INTEGRATION = Work(
    name="integration",
    what="forty periods from rest, simplified bimorph",
    amplitude=Axis("F0", 0.02, 0.2),
    frequency=Axis("f", 60.0, 180.0),
    measures=(Measure("max_x"), Measure("max_psi"), Measure("lift", crosses_zero=True)),
    rtol=(1e-10, 1e-2),
    rtol_limits="from 1e-10, where the reference ends, to 1e-2",
    reference=Cpp("reference.cpp", ("-O2",), BOOST),
    base=BASE,
    peers=(
        BASE,
        Peer(
            "flap",
            "flap (program `examples/own_equations`): Dormand-Prince 5(4) in lanes",
            Cargo(
                REPOSITORY,
                ("-p", "flap-core", "--example", "own_equations"),
                TARGET / "release" / "examples" / "own_equations",
            ),
            samples=False,
        ),
        Peer(
            "ode_solvers",
            "ode_solvers in Rust: Dormand-Prince 5(4) with dense output",
            # Built for the processor at hand it is no faster.
            Cargo(PEERS / "rust", ("--target-dir", str(WORK / "rust")), WORK / "rust" / "release" / "flap-peer"),
        ),
        Peer("cyrk", "CyRK (Python, C++), RK45", Python("cyrk_rk45.py", (NUMPY, NUMBA, "CyRK==0.20.0"))),
        Peer(
            "heyoka",
            "heyoka in Python: Taylor series in lanes, kinks located as events",
            Python("heyoka_taylor.py", (NUMPY, "heyoka==7.13.2")),
        ),
        Peer(
            "scipy",
            "SciPy solve_ivp: RK45 in plain Python",
            Python("scipy_rk45.py", (NUMPY, SCIPY)),
            most_points=8,
        ),
        Peer(
            "numba_rk4",
            "handwritten Runge-Kutta 4 in Python with numba",
            Python("numba_rk4.py", (NUMPY, NUMBA)),
            adaptive=False,
        ),
        Peer(
            "rk4_lanes",
            "handwritten Runge-Kutta 4 in lanes in C++",
            Cpp(
                "rk4_lanes.cpp",
                ("-O3", processor_flag("native"), "-ffast-math", "-fopenmp-simd", "-mprefer-vector-width=512"),
                GXX,
            ),
            adaptive=False,
        ),
    ),
)

"""The benchmarks `settled` and `responses`. The bimorph model is integrated from rest until the motion has settled, and
is measured over the next drive period.
"""

from __future__ import annotations

from dataclasses import replace

from .build import BOOST, GXX, NUMBA, NUMPY, REPOSITORY, SCIPY, TARGET, Cargo, Cpp, Python, Through, processor_flag
from .peer import Peer
from .work import Axis, Measure, Work

COMMAND = Cargo(REPOSITORY, ("-p", "flap-cli"), TARGET / "release" / "flap")

BASE = Peer(
    "boost",
    "Boost.Odeint in C++: Dormand-Prince 5(4), marching",
    Cpp("settled_boost.cpp", ("-O3", processor_flag("x86-64-v3")), BOOST),
)

PEERS_IN_TURN: tuple[Peer, ...] = (
    BASE,
    Peer("flap", "flap sweep", Through("settled_flap.py", COMMAND, ("true",)), samples=False),
    Peer(
        "flap_marching",
        "flap sweep with newton = false",
        Through("settled_flap.py", COMMAND, ("false",)),
        samples=False,
    ),
    Peer(
        "scipy",
        "SciPy solve_ivp: RK45 in plain Python, marching",
        Python("settled_scipy.py", (NUMPY, SCIPY)),
        most_points=16,
    ),
    Peer(
        "numba_rk4",
        "handwritten Runge-Kutta 4 in Python with numba, marching",
        Python("settled_numba.py", (NUMPY, NUMBA)),
        adaptive=False,
    ),
    Peer(
        "rk4_lanes",
        "handwritten Runge-Kutta 4 in lanes in C++, marching",
        Cpp(
            "settled_rk4_lanes.cpp",
            ("-O3", processor_flag("native"), "-ffast-math", "-fopenmp-simd", "-mprefer-vector-width=512"),
            GXX,
        ),
        adaptive=False,
    ),
)

SETTLED = Work(
    name="settled",
    what="settled motions around the flight of jafferis2016",
    # 60 to 100 % of the preset's voltage, 85 to 110 % of its frequency: every motion settles to one drive period.
    amplitude=Axis("drive_voltage_pp", 120.0, 200.0),
    frequency=Axis("drive_frequency", 102.0, 132.0),
    measures=(
        Measure("stroke_pp_deg"),
        Measure("pitch_pp_deg"),
        Measure("lift_mean_mn", crosses_zero=True),
        Measure("power_mean_mw"),
    ),
    rtol=(1e-10, 1e-6),
    rtol_limits="from 1e-10, where the reference ends, to 1e-6, the residual",
    reference=Cpp("settled_reference.cpp", ("-O2",), BOOST),
    base=BASE,
    peers=PEERS_IN_TURN,
)

RESPONSES = replace(
    SETTLED,
    name="responses",
    what="settled motions of the frequency responses of jafferis2016 at many voltages",
    # Those of examples/jafferis_fig4.toml, with motions that settle slowly.
    amplitude=Axis("drive_voltage_pp", 40.0, 240.0),
    frequency=Axis("drive_frequency", 40.0, 200.0),
)

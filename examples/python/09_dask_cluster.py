"""A sweep spread over the processes of a cluster, with the same result as on one machine.

The script starts a small Dask cluster on this machine and runs a sweep on the cluster, with one result file. The script
also runs the sweep without a cluster, and checks that both files have the same bytes. If a worker dies, other workers
run the points of the lost worker again. To continue an interrupted sweep, repeat the call, with or without the cluster.

    python 09_dask_cluster.py
    python 09_dask_cluster.py --size full --workers 8 --out sweep.csv

For a real cluster, replace the line that contains `LocalCluster(...)`. For SLURM (pip install dask-jobqueue), write:

    from dask_jobqueue import SLURMCluster
    cluster = SLURMCluster(cores=1, memory="2GB", walltime="01:00:00")
    cluster.scale(64)

For Kubernetes (pip install dask-kubernetes), use an image that contains flapwing, and write:

    from dask_kubernetes.operator import KubeCluster
    cluster = KubeCluster(image="registry.example/flapwing")
    cluster.scale(64)

All workers must have the same build of flapwing, and processors with the same rounding. If the builds or the rounding
of two workers differ, the sweep ends with an error. The workers do not write the result file, because the process of
the script writes the file.

The script requires Dask: pip install distributed

M. Rocklin, "Dask: parallel computation with blocked algorithms and task scheduling", Proc. 14th Python in Science
Conf. (2015) 126-132.
"""

import argparse
import filecmp
import os
import tempfile
import time
from typing import Any

import flapwing
from distributed import Client, LocalCluster

STEP_HZ = {"small": 1.0, "full": 0.02}


def grid(step: float) -> dict[str, Any]:
    return {
        "preset": "ozaki2018-large",
        "axes": {
            "hinge_stiffness": {"from": "70 uN*m/rad", "to": "110 uN*m/rad", "n": 9},
            "drive_frequency": {"from": "90 Hz", "to": "130 Hz", "step": f"{step} Hz"},
        },
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--size", choices=list(STEP_HZ), default="small")
    parser.add_argument("--workers", type=int, default=2, help="processes, with one thread each")
    parser.add_argument("--out", metavar="FILE", help="keep the rows: .csv, .csv.zst or .parquet")
    arguments = parser.parse_args()

    space = flapwing.Grid(grid(STEP_HZ[arguments.size]))
    with tempfile.TemporaryDirectory() as folder:
        out = arguments.out or os.path.join(folder, "cluster.csv")
        with (
            # Only this machine can reach the cluster. `cluster.dashboard_link` is a page on its progress.
            LocalCluster(
                n_workers=arguments.workers,
                threads_per_worker=1,
                processes=True,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
            ) as cluster,
            Client(cluster) as client,
        ):
            begin = time.perf_counter()
            table = flapwing.sweep(space, client=client, out=out)
            seconds = time.perf_counter() - begin
        statuses = ", ".join(f"{count} {status}" for status, count in table.counts.items())
        print(f"{len(table)} points on {arguments.workers} workers in {seconds:.1f} s: {statuses}")
        row = table["lift_mean_mn"].argmax()
        print(f"most lift: {table['lift_mean_mn'][row]:.3f} mN at {table['drive_frequency'][row]:g} Hz")

        local = os.path.join(folder, "local-" + os.path.basename(out))
        flapwing.sweep(space, out=local)
        if not filecmp.cmp(out, local, shallow=False):
            raise SystemExit(
                "The rows differ from those of a sweep without the cluster. That is a bug: please report it."
            )
        print("The same bytes as without the cluster.")
        if arguments.out:
            print(f"wrote {arguments.out}")


if __name__ == "__main__":
    # Worker processes import this file, and must not start clusters of their own.
    main()

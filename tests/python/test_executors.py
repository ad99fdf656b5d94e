"""Sweeps on the workers of executors other than a Dask cluster."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor

import flapwing
import numpy as np
import pytest
from flapwing import _workers
from grids import GRID, LONG


@pytest.fixture(scope="module")
def pool():
    """Two worker processes, which share no memory with this one."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        yield pool


class Recorder:
    """An executor without a number of workers, like submitit's: its tasks run when their results are requested."""

    def __init__(self):
        self.submitted, self.cancelled, self.waiting, self.most_waiting = [], 0, 0, 0

    def submit(self, function, /, *arguments):
        self.submitted.append((function.__name__, arguments))
        self.waiting += 1
        self.most_waiting = max(self.most_waiting, self.waiting)
        return self.Task(self, function, arguments)

    class Task:
        def __init__(self, recorder, function, arguments):
            self.recorder, self.function, self.arguments = recorder, function, arguments

        def result(self):
            self.recorder.waiting -= 1
            return self.function(*self.arguments)

        def cancel(self):
            self.recorder.cancelled += 1


def test_a_process_pool_writes_the_bytes_of_one_machine(pool, tmp_path):
    for ending in ("csv", "csv.zst", "parquet"):
        far, near = tmp_path / f"far.{ending}", tmp_path / f"near.{ending}"
        flapwing.sweep(GRID, client=pool, out=far)
        flapwing.sweep(GRID, out=near)
        assert far.read_bytes() == near.read_bytes()


def test_batches_responses_and_points_are_those_of_one_machine(pool):
    columns = {"drive_frequency": np.linspace(96.0, 118.0, 40)}
    curves = {"preset": "jafferis2016", "axes": {"hinge_stiffness": ["0.7486 uN*m/rad", "1 uN*m/rad"]}}
    calls = [
        lambda **there: flapwing.evaluate("ozaki2018-large", columns, gradient=["hinge_stiffness"], **there),
        lambda **there: flapwing.respond(curves, start="122 Hz", stop="128 Hz", step="1 Hz", **there),
        lambda **there: flapwing.trajectory("ozaki2018-large", samples=50, **there),
    ]
    for call in calls:
        far, near = call(client=pool), call()
        assert far.columns == near.columns and far.meta == near.meta
        for name in near:
            np.testing.assert_array_equal(far[name], near[name], strict=True)
    assert flapwing.run("ozaki2018-large", client=pool) == flapwing.run("ozaki2018-large")


def test_threads_are_workers_too():
    with ThreadPoolExecutor(2) as pool:
        far, near = flapwing.sweep(GRID, client=pool), flapwing.sweep(GRID)
    np.testing.assert_array_equal(far["lift_mean_mn"], near["lift_mean_mn"])


def test_tasks_have_the_chosen_number_of_points_and_a_bounded_number_waits():
    recorder = Recorder()
    table = flapwing.sweep(LONG, client=recorder, points_per_task=50, threads=2)
    assert len(table) == 8000 and len(recorder.submitted) == 160
    assert [arguments[2:] for _, arguments in recorder.submitted] == [(50 * i, 50 * i + 50, 2) for i in range(160)]
    assert recorder.most_waiting == 4 * _workers._UNKNOWN_WORKERS and recorder.cancelled == 0

    recorder = Recorder()
    grid = {"preset": "ozaki2018-large", "axes": {"drive_frequency": [100, 105]}}
    flapwing.evaluate(grid, {"drive_voltage_pp": np.linspace(60, 80, 9)}, client=recorder, points_per_task=6)
    assert [len(arguments[2]["drive_voltage_pp"]) for _, arguments in recorder.submitted] == [3, 3, 3]


def test_workers_that_start_later_get_tasks():
    class Growing(Recorder):
        def nthreads(self):
            """One thread at first, and a further thread after each result."""
            return dict.fromkeys(range(1 + len(self.submitted) - self.waiting), 1)

    recorder = Growing()
    assert len(flapwing.sweep(GRID, client=recorder, points_per_task=1)) == 24
    assert recorder.most_waiting > 20
    # Without workers at first, tasks are small.
    recorder.nthreads = dict
    assert _workers._task_size(recorder, 8000, 1, None) == 125


@pytest.mark.parametrize(("workers", "threads", "size"), [(2, 1, 1000), (1, 1, 2000), (2, 4, 1000), (16, 1, 125)])
def test_by_default_every_worker_gets_points(workers, threads, size):
    with ThreadPoolExecutor(workers) as pool:
        assert _workers._task_size(pool, 8000, threads, None) == size
        assert _workers._task_size(pool, 10**7, threads, None) == 2048 * threads


def test_an_exception_of_the_user_cancels_the_tasks():
    class Slow(Recorder):
        class Task(Recorder.Task):
            def result(self):
                # Progress is reported every 50 ms.
                time.sleep(0.1)
                return super().result()

    def stop(done, points):
        if done > 0:
            raise RuntimeError("enough")

    recorder = Slow()
    with pytest.raises(RuntimeError, match="enough"):
        flapwing.evaluate(
            "ozaki2018-large", {"drive_frequency": np.linspace(95, 100, 10)}, client=recorder, progress=stop
        )
    assert len(recorder.submitted) == 10 and recorder.cancelled == 9


def test_a_sweep_continues_after_an_interruption(tmp_path):
    script = f"""
import multiprocessing, signal, time, flapwing
from concurrent.futures import ProcessPoolExecutor

# The processes that run tests ignore Ctrl-C, and pass this on to the processes that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)

def progress(done, points):
    print(done, flush=True)
    if done > 0:
        time.sleep(60)

if __name__ == "__main__":
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        try:
            flapwing.sweep({LONG!r}, client=pool, out="rows.csv", progress=progress)
        except KeyboardInterrupt:
            print("interrupted")
"""
    (tmp_path / "script.py").write_text(script)
    process = subprocess.Popen([sys.executable, "script.py"], cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    while int(process.stdout.readline()) == 0:
        pass
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 0 and output.endswith("interrupted\n")
    rows = tmp_path / "rows.csv"
    assert 0 < rows.read_text().count("\n") < 8000
    flapwing.sweep(LONG, out=rows)
    flapwing.sweep(LONG, out=tmp_path / "whole.csv")
    assert rows.read_bytes() == (tmp_path / "whole.csv").read_bytes()


def test_a_dead_worker_is_an_error_with_a_remedy(tmp_path):
    out = tmp_path / "rows.csv"
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        pool.submit(os._exit, 1)
        with pytest.raises(RuntimeError) as caught:
            flapwing.sweep(GRID, client=pool, out=out)
    assert str(caught.value).startswith("a worker of `client` died: ")
    assert "then call again with a new executor; a sweep with `out` continues" in str(caught.value)


def test_errors_of_workers_have_a_note():
    class Failing:
        def submit(self, function, /, *arguments):
            future = Future()
            future.set_exception(MemoryError("too little"))
            return future

    with pytest.raises(MemoryError) as caught:
        flapwing.sweep(GRID, client=Failing())
    assert caught.value.__notes__ == ["raised by a task of `client`; a sweep with `out` continues if you call it again"]


def test_mistakes(pool):
    for wrong in ("here", 3, ProcessPoolExecutor):
        with pytest.raises(TypeError, match="`client` is .*\nit must be an executor, such as concurrent.futures"):
            flapwing.sweep(GRID, client=wrong)
    columns = {"drive_frequency": [100.0]}
    with pytest.raises(ValueError, match="`points_per_task` must be 1 or more, not 0"):
        flapwing.sweep(GRID, client=pool, points_per_task=0)
    with pytest.raises(TypeError, match="`points_per_task` must be a whole number, not float"):
        flapwing.evaluate("ozaki2018-large", columns, client=pool, points_per_task=2.5)
    with pytest.raises(TypeError, match="`threads` must be a whole number, not str"):
        flapwing.sweep(GRID, client=pool, threads="two")

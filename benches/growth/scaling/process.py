"""Processes, and the time and the memory that the processes use."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

#: Time between two readings of the memory of running processes (s).
INTERVAL = 0.005


class Failed(Exception):
    """The error for a process that ended with an error code."""


@dataclass(frozen=True)
class Usage:
    """The time and the memory that several simultaneous processes used."""

    wall_s: float
    #: The CPU time of all processes together (s).
    cpu_s: float
    #: Peak resident memory of the largest process (MiB).
    peak_mib: float


def together(commands: Sequence[Sequence[str]]) -> Usage:
    """Run commands at the same time, and wait until all commands have ended."""
    with tempfile.TemporaryFile() as errors:
        begin = time.perf_counter()
        running = [
            subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors)
            for command in commands
        ]
        try:
            return watch(running, errors, begin)
        finally:
            for process in running:
                if process.returncode is None:
                    process.kill()
                    process.wait()


def watch(running: Sequence[subprocess.Popen[bytes]], errors: IO[bytes], begin: float) -> Usage:
    """Wait for processes, and read the memory of the running processes at regular times."""
    cpu = peak = 0.0
    while any(process.returncode is None for process in running):
        for process in running:
            if process.returncode is not None:
                continue
            peak = max(peak, peak_so_far(process.pid))
            ended, status, used = os.wait4(process.pid, os.WNOHANG)
            if ended == 0:
                continue
            process.returncode = os.waitstatus_to_exitcode(status)
            cpu += used.ru_utime + used.ru_stime
            if sys.platform == "darwin":
                peak = max(peak, used.ru_maxrss / 2**20)
            if process.returncode != 0:
                errors.seek(0)
                raise Failed(errors.read().decode(errors="replace").strip() or f"it ended with {process.returncode}")
        time.sleep(INTERVAL)
    return Usage(time.perf_counter() - begin, cpu, peak)


def peak_so_far(number: int) -> float:
    """Return the peak resident memory of a running process (MiB), or 0 if the system does not report the memory. On
    Linux, the result of `wait4` for an ended process is not usable: it is at least the memory of the parent process."""
    try:
        lines = Path(f"/proc/{number}/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0
    peaks = [line.split()[1] for line in lines if line.startswith("VmHWM:")]
    return int(peaks[0]) / 1024 if peaks else 0.0

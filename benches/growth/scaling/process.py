"""Processes and what they use."""

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

#: Seconds between two looks at the memory of running processes.
INTERVAL = 0.005


class Failed(Exception):
    """A process ended with an error."""


@dataclass(frozen=True)
class Usage:
    """What processes that ran at the same time have used."""

    wall_s: float
    #: Of all of them together.
    cpu_s: float
    #: Peak resident memory of the largest (MiB).
    peak_mib: float


def together(commands: Sequence[Sequence[str]]) -> Usage:
    """Runs commands at the same time, to their ends."""
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
    """Waits for processes, and looks at their memory meanwhile."""
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
    """The peak resident memory of a running process (MiB); 0 where the system does not tell. What `wait4` tells of an
    ended process on Linux is at least the memory of this one, from which it was forked."""
    try:
        lines = Path(f"/proc/{number}/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0
    peaks = [line.split()[1] for line in lines if line.startswith("VmHWM:")]
    return int(peaks[0]) / 1024 if peaks else 0.0

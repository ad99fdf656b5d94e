"""The command `flap`, which is part of the wheel."""

import shutil
import signal
import sys

from flapwing import _flapwing


def main() -> int:
    """Run the command line of this process and return its exit code."""
    # Python would handle Ctrl-C only after the command.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    program, *arguments = sys.argv
    # Completion scripts name a command that the shell finds without its folder.
    return _flapwing.command(["flap" if shutil.which("flap") == program else program, *arguments])

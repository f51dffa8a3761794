"""The command ``laneweave``."""

import signal
import sys

from . import _laneweave

PROGRAM = [sys.executable, "-m", "laneweave"]
"""How a process of the command begins."""


def main() -> int:
    """Does what the command line asks for, and returns the exit code."""
    # Ctrl-C ends the command as it ends the program: by its own rules, or at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _laneweave.command(["laneweave", *sys.argv[1:]], PROGRAM)

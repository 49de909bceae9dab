"""The command-line program, as ``holdfast`` and ``python -m holdfast``."""

from __future__ import annotations

import sys

from . import _core


def main() -> int:
    """Runs the program on the words of this process; its exit code."""
    return _core.run_program(["holdfast", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())

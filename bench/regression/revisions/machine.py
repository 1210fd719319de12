"""The machine that laws are compiled for when they are compared: the same wherever this is run.

Compiled for the processor at hand, the same source has other instructions on each. Valgrind also knows none of the
newest. So both sides are compiled for a level that many processors share.
"""

import functools
import os
import platform
from pathlib import Path

LEVEL = "x86-64-v3"
NEEDED = {"avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"}
"""What a processor of that level has beyond x86-64, in the kernel's words."""

PLAIN = "generic"
"""numba's word for the architecture without extensions."""


@functools.cache
def target() -> str:
    """The level, or no extension at all where this processor lacks it or is another."""
    info = Path("/proc/cpuinfo")
    flags = info.read_text(encoding="utf-8").split() if info.is_file() else []
    return LEVEL if platform.machine() == "x86_64" and set(flags) >= NEEDED else PLAIN


def environment(checkout: Path) -> dict[str, str]:
    """Variables of a process that compiles a checkout's laws for the target; none of a pytest that asks for it.

    Under pytest-xdist's, pytest-benchmark would switch itself off.
    """
    ours = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    chosen = {"PYTHONPATH": str(checkout), "NUMBA_CPU_NAME": target(), "NUMBA_CPU_FEATURES": ""}
    return {**ours, **chosen, "PYTHONHASHSEED": "0"}

"""The wheels that the locks name, for the system and the Python of this machine."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from report.edition import CannotMake

REQUIREMENTS = Path(__file__).resolve().parents[2] / "requirements"
LOCKS = ("install", "report")
"""What installs, and what make bench and make report need; the lock of bench is a part of it."""


def archive(folder: Path) -> str:
    """All that make bench and make report install, as wheels."""
    target = folder / "wheels"
    target.mkdir(exist_ok=True)
    locks = [word for name in LOCKS for word in ("-r", str(REQUIREMENTS / f"{name}.txt"))]
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-input"]
    command += ["--require-hashes", "--no-deps", "--only-binary", ":all:", "--dest", str(target), *locks]
    asked = subprocess.run(command, capture_output=True, text=True, check=False)
    if asked.returncode:
        raise CannotMake(f"pip could not fetch the wheels (cure: a network, or pip's cache):\n{asked.stderr.strip()}")
    return f"{sum(1 for _ in target.glob('*.whl'))} wheels"

"""Folders for what is kept between processes, also where HOME cannot be written, as under `docker run --user`."""

import contextlib
import os
import tempfile
from pathlib import Path

from bench.provenance import ROOT


def folder(variable: str, usual: str, instead: Path = ROOT / ".home") -> Path:
    """Ours in the folder that a variable names, or in the usual one at home; else in .home of the checkout, as `make`.

    Where neither can be written, a new one, for this process and those that it starts.
    """
    named = os.environ.get(variable) or os.path.join(os.path.expanduser("~"), usual)
    for path in (Path(named), instead / usual):
        ours = path / "orientation-bench"
        with contextlib.suppress(OSError):
            if path.is_absolute():  # of a user without a name home is "~"
                ours.mkdir(parents=True, exist_ok=True)
            if os.access(ours, os.W_OK | os.X_OK):
                return ours
    os.environ[variable] = tempfile.mkdtemp(prefix="orientation-bench-")
    return folder(variable, usual, instead)

"""Folders for what is kept between processes: this user's at home, or where HOME cannot be written, another place.

In a container HOME is often a folder that nobody may write, or none (`docker run --user`).
"""

import os
import tempfile
from pathlib import Path

from bench.errors import MissingTool
from bench.provenance import ROOT

USUAL = {"XDG_CACHE_HOME": ".cache", "XDG_STATE_HOME": ".local/state"}
"""Variables that may name a folder, and which one at home it is if they do not."""

INSTEAD = ROOT / ".home"
"""In place of HOME; the Makefile gives it to the tools too."""


def folder(variable: str) -> Path:
    """Ours in the folder of a variable of USUAL; else in INSTEAD; else one in the temporary folder, this user's alone.

    Errors:
        MissingTool: none of them can be written.
    """
    usual = os.environ.get(variable) or os.path.join(os.path.expanduser("~"), USUAL[variable])
    temporary = Path(tempfile.gettempdir(), f"orientation-bench-{os.getuid()}")
    for path in (Path(usual), INSTEAD / USUAL[variable], temporary / USUAL[variable]):
        if not path.is_absolute():
            continue  # a user without a name has no home
        try:
            if path.is_relative_to(temporary):
                temporary.mkdir(mode=0o700, exist_ok=True)
                if temporary.lstat().st_uid != os.getuid():
                    continue  # somebody else's code may lie there
            ours = path / "orientation-bench"
            ours.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(ours, os.W_OK | os.X_OK):
            return ours
    raise MissingTool(f"{usual}, {INSTEAD} and {temporary} cannot be written; name a folder that can in {variable}")

"""Starts on arms as they were found before: to search those of four arms takes ten seconds.

`arm_starts/found/<arm>.json` has the sets of an arm at their usual size and seed. A set is taken from there only if
all that decides it is the same as when it was found: the files of the search, the arm, MuJoCo and NumPy. Otherwise it
is searched for, as other sizes and seeds are. After a change of such a file

    python -m tasks.found_starts

searches for the sets of every arm and writes the files again.
"""

from __future__ import annotations

import functools
import hashlib
import importlib
import importlib.metadata
import json
from collections.abc import Iterable
from pathlib import Path

from tasks.arm import arm, arm_names
from tasks.arm_model import Arm
from tasks.base import ArmStartSet, Start

FOLDER = Path(__file__).parent / "arm_starts" / "found"

SEED = 0
"""The usual seed."""

DECIDING = (
    "arm_model",
    "arm_starts.clear",
    "base",
    "clearance",
    "errors",
    "haar",
    "kinematics",
    "linear_algebra",
    "paths",
    "rotations",
    "sensors",
    "singular",
    "truth",
)
"""Modules of tasks that the searches import, besides the file of the set."""

PACKAGES = ("mujoco", "numpy")
"""What computes the poses."""


def read(arm: Arm, chosen: ArmStartSet, count: int, seed: int, folder: Path = FOLDER) -> tuple[Start, ...] | None:
    """Return the starts of a set that were found before; None if these were not, or by other files."""
    if seed != SEED or count != chosen.size:
        return None
    kept = read_sets(arm.name, folder).get(chosen.name)
    if kept is None or kept["digest"] != digest_of(arm, chosen):
        return None
    starts = []
    for name, *vectors in kept["starts"]:
        starts.append(Start(name, *map(tuple, vectors)))
    return tuple(starts)


@functools.lru_cache(maxsize=4)
def read_sets(arm: str, folder: Path = FOLDER) -> dict[str, dict]:
    """Return the sets of an arm's file by name, each with its digest and starts; empty if there is no file."""
    path = folder / f"{arm}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def digest_of(
    arm: Arm, chosen: ArmStartSet, modules: tuple[str, ...] = DECIDING, packages: tuple[str, ...] = PACKAGES
) -> str:
    """Return 64 hex digits over all that decides the starts of a set on an arm."""
    total = hashlib.sha256(repr((arm, chosen.name, chosen.size)).encode())
    for name in (*(f"tasks.{module}" for module in modules), chosen.build.__module__):
        total.update(Path(str(importlib.import_module(name).__file__)).read_bytes())
    for package in packages:
        total.update(importlib.metadata.version(package).encode())
    return total.hexdigest()


def write(arm: Arm, sets: Iterable[ArmStartSet], folder: Path = FOLDER) -> Path:
    """Search for the sets of an arm, write them into its file, and return the file."""
    lines = []
    for chosen in sets:
        starts = chosen.build(arm, chosen.size, SEED)[: chosen.size]
        rows = ",\n".join(json.dumps(start) for start in starts)
        digest = json.dumps(digest_of(arm, chosen))
        lines.append(f'{json.dumps(chosen.name)}: {{"digest": {digest}, "starts": [\n{rows}\n]}}')
    path = folder / f"{arm.name}.json"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text("{" + ",\n".join(lines) + "}\n", encoding="utf-8")
    return path


def main() -> None:
    """Write the files of all arms, and remove those of arms that are there no more."""
    from tasks import find_start_set, start_set_names

    found = (find_start_set(name, arm=True) for name in start_set_names(arm=True))
    sets = [chosen for chosen in found if isinstance(chosen, ArmStartSet)]
    written = set()
    for name in arm_names():
        path = write(arm(name), sets)
        written.add(path)
        print(f"{path}: {path.stat().st_size / 1e3:.0f} kB", flush=True)
    for path in FOLDER.glob("*.json"):
        if path not in written:
            path.unlink()


if __name__ == "__main__":
    main()

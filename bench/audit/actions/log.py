"""Read poses, actions and episodes from a file of arrays (.npz) or a table (.parquet)."""

import importlib
import re
import zipfile
from pathlib import Path

import numpy as np

from bench.audit.actions.conventions import REPRESENTATIONS
from bench.base.errors import BadNumber, MissingTool, UnknownWord

POSES, NEXT = ("R", "pose", "quat", "observation.state"), ("R_next", "next_R", "next_pose", "next_quat")
EPISODES = ("episode_index", "episode")
READINGS = {3: ("rotation-vector", "euler-xyz", "euler-XYZ"), **{n: tuple(REPRESENTATIONS[n]) for n in (4, 6)}}
READINGS[9] = ("matrix-rows",)
"""Readings of a pose that are tried, by its count of numbers, if none is stated."""


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return the arrays of a file by name."""
    if path.suffix == ".npz":
        with zipfile.ZipFile(path) as file:
            return {one[:-4]: np.lib.format.read_array(file.open(one), allow_pickle=False) for one in file.namelist()}
    try:
        table = importlib.import_module("pyarrow.parquet").read_table(path)
    except ImportError:
        raise MissingTool(f"{path} is read with pyarrow, which is missing; pip install pyarrow, or save .npz") from None
    return {one: np.array(table[one].to_pylist()) for one in table.column_names if "image" not in one}


def find_column(arrays: dict, stated: str | None, usual: tuple[str, ...] = ("action",)) -> tuple[np.ndarray, str]:
    """Return the numbers (n x m) of "name", "name[3:6]" or "name[3:6]:reading", and the reading or ""."""
    column = stated or next((one for one in usual if one in arrays), usual[0])
    (parts,) = re.findall(r"^(.*?)(?:\[(\d*):(\d*)\])?(?::([\w-]+))?$", column)
    name, start, stop, reading = parts
    if name not in arrays:
        raise UnknownWord("column", name, sorted(arrays))
    values = arrays[name].astype(float)
    values = values[:, :3, :3] if values.shape[1:] == (4, 4) else values
    return values.reshape(len(values), -1)[:, int(start or 0) : int(stop) if stop else None], reading


def read_poses(values: np.ndarray, reading: str) -> dict[str, np.ndarray]:
    """Return the orientations (n x 3 x 3) by every reading that the numbers may have, or by the stated one."""
    width = values.shape[1]
    if width not in READINGS:
        raise BadNumber(f"a pose has {width} numbers, not 3, 4, 6 or 9; give its rotation, as --pose NAME[3:6]")
    if reading and reading not in REPRESENTATIONS[width]:
        raise UnknownWord("reading", reading, list(REPRESENTATIONS[width]))
    unit = np.pi / 180.0 if width == 3 and np.abs(values).max() > 7.0 else 1.0  # no angle in radians is so large
    return {one: REPRESENTATIONS[width][one](unit * values) for one in ([reading] if reading else READINGS[width])}

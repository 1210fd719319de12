"""Read poses, actions and episodes from a file of arrays (.npz) or a table (.parquet)."""

import importlib
import re
import zipfile
import zlib
from pathlib import Path

import numpy as np
from numpy.lib.format import read_array

from bench.audit.actions.conventions import REPRESENTATIONS
from bench.base.errors import BadLog, BadNumber, MissingTool, UnknownWord

POSES, NEXT = ("R", "pose", "quat", "observation.state"), ("R_next", "next_R", "next_pose", "next_quat")
EPISODES = ("episode_index", "episode")
READINGS = {3: ("rotation-vector", "euler-xyz", "euler-XYZ"), **{n: tuple(REPRESENTATIONS[n]) for n in (4, 6)}}
READINGS[9] = ("matrix-rows",)
"""Readings of a pose that are tried, by its count of numbers, if none is stated."""


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return the arrays of a file by name; MissingTool for a table where pyarrow is not installed."""
    if path.suffix not in (".npz", ".parquet"):
        raise BadLog(f"{path} is no .npz and no .parquet file; save the log with np.savez, or as a table")
    try:
        if path.suffix == ".npz":
            with zipfile.ZipFile(path) as file:
                return {one[:-4]: read_array(file.open(one), allow_pickle=False) for one in file.namelist()}
        table = importlib.import_module("pyarrow.parquet").read_table(path)
        return {one: np.array(table[one].to_pylist()) for one in table.column_names if "image" not in one}
    except ImportError:
        raise MissingTool(f"{path} is read with pyarrow, which is missing; pip install pyarrow, or save .npz") from None
    except FileNotFoundError:
        raise BadLog(f"there is no file {path}; give the path of a .npz or .parquet file") from None
    except (OSError, ValueError, EOFError, zlib.error, zipfile.BadZipFile) as error:
        raise BadLog(
            f"{path} cannot be read ({error}); save arrays of numbers, each with one row for a step"
        ) from error


def find_column(arrays: dict, stated: str | None, usual: tuple[str, ...] = ("action",)) -> tuple[np.ndarray, str]:
    """Return the numbers (n x m) of "name", "name[3:6]" or "name[3:6]:reading", and the reading or ""."""
    column = stated or next((one for one in usual if one in arrays), usual[0])
    (parts,) = re.findall(r"^(.*?)(?:\[(\d*):(\d*)\])?(?::([\w-]+))?$", column)
    name, start, stop, reading = parts
    if name not in arrays:
        raise UnknownWord("column", name, sorted(arrays))
    try:
        values = arrays[name].astype(float)
    except (TypeError, ValueError) as error:
        raise BadLog(f"column '{name}' has something else than numbers ({error}); give another column") from error
    if not values.size:
        raise BadLog(f"column '{name}' has no rows; give a log of at least some hundred steps")
    values = values[:, :3, :3] if values.shape[1:] == (4, 4) else values
    values = values.reshape(len(values), -1)
    first, last = int(start or 0), int(stop or values.shape[1])
    if not first < last <= values.shape[1]:
        raise BadLog(f"'{column}' is outside of '{name}', which has {values.shape[1]} numbers; they are counted from 0")
    return values[:, first:last], reading


def read_poses(values: np.ndarray, reading: str) -> dict[str, np.ndarray]:
    """Return the orientations (n x 3 x 3) by every reading that the numbers may have, or by the stated one."""
    width = values.shape[1]
    if width not in READINGS:
        raise BadNumber(f"a pose has {width} numbers, not 3, 4, 6 or 9; give its rotation, as --pose NAME[3:6]")
    if reading and reading not in REPRESENTATIONS[width]:
        raise UnknownWord("reading", reading, list(REPRESENTATIONS[width]))
    unit = np.pi / 180.0 if width == 3 and np.abs(values).max() > 7.0 else 1.0  # no angle in radians is so large
    return {one: REPRESENTATIONS[width][one](unit * values) for one in ([reading] if reading else READINGS[width])}

"""python -P -m bench.studies.restated FOLDER: compare each restated controller with its source; writes restated.json.

FOLDER has a copy of each repository as `owner+name` or `owner+name/repo`: a clone, bare or not, that has the commit of
`SHIPPED.source`, or, of a release, its files. A file of sources/ is a few lines of ours around the lines of theirs: a
line `//@ FILE FIRST-LAST` or `#@ FILE FIRST-LAST` stands for these lines of FILE at that commit. It is built in a
folder that is removed afterwards, and none of their code stays here. The marks of the last file named are the error
block. What is not built keeps its earlier row of the same lines. C++ needs g++, Eigen, KDL and, by --include,
pinocchio's headers; Python needs torch, mujoco and pinocchio.

Compared are pairs of orientations: half of them uniform, a quarter within 1e-5 to 0.1 rad of the goal, a quarter as
near a 180° rotation. Above 175° the greatest difference is kept apart: an axis from a matrix loses digits there.
"""

import ctypes
import re
import runpy
import subprocess
import tempfile
import textwrap
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from bench.base.files import read_json, write_json
from bench.findings.libraries import RESTATED
from bench.law.contenders.registry import contenders
from bench.law.shipped import AsShipped
from bench.studies.study import describe_study, make_parser

SOURCES = Path(__file__).parent / "sources"
PAIRS = 10_000
KEPT = np.arange(0, PAIRS, PAIRS // 20)
"""Pairs whose errors by the source are kept, so that the kernels are held to them without it."""
NEAREST_RAD, FARTHEST_RAD = 1e-5, 0.1
NEAR_180_RAD = np.radians(175.0)
MARK = re.compile(r"^(?P<indent> *)(?://|#)@ (?P<file>\S+) (?P<first>\d+)-(?P<last>\d+)$", re.MULTILINE)
COMPILE = ("g++", "-O1", "-shared", "-fPIC", "-std=c++17", "-I/usr/include/eigen3", "-I/usr/include/kdl")

Errors = Callable[[np.ndarray], np.ndarray]
"""Pairs (n x 8: goal, now; w, x, y, z) -> errors in the base frame (n x 3)."""


def pairs() -> np.ndarray:
    """Return the pairs of orientations, n x 8."""
    rng = np.random.default_rng(20260)
    now = Rotation.random(PAIRS, rng=rng)
    turns = Rotation.random(PAIRS, rng=rng).as_rotvec()
    axis = turns / np.linalg.norm(turns, axis=1)[:, None]
    short = 10.0 ** rng.uniform(np.log10(NEAREST_RAD), np.log10(FARTHEST_RAD), PAIRS)
    quarter = PAIRS // 4
    turns[:quarter] = axis[:quarter] * short[:quarter, None]
    turns[quarter : 2 * quarter] = axis[quarter : 2 * quarter] * (np.pi - short[quarter : 2 * quarter, None])
    goal = Rotation.from_rotvec(turns) * now
    return np.hstack([one.as_quat(scalar_first=True) for one in (goal, now)])


def filled(one: AsShipped, template: str, folder: Path) -> str:
    """Return a file of sources/ with the lines of theirs in the places of its marks."""
    repository, _, revision = one.source.partition("@")
    name = repository.replace("/", "+")
    copies = [path for path in (folder / name / "repo", folder / name) if path.is_dir()]
    if not copies:
        raise FileNotFoundError(f"no copy of {repository} in the folder")

    def lines(mark: re.Match) -> str:
        command = ["git", "-C", str(copies[0]), "show", f"{revision}:{mark['file']}"]
        shown = subprocess.run(command, capture_output=True, text=True, check=False)
        text = (copies[0] / mark["file"]).read_text() if shown.returncode else shown.stdout  # a release has no history
        own = text.splitlines()[int(mark["first"]) - 1 : int(mark["last"])]
        return textwrap.indent(textwrap.dedent("\n".join(own)), mark["indent"])

    return MARK.sub(lines, template)


def built(source: Path, code: str, options: list[str]) -> Errors:
    """Return the errors that a filled file computes: C++ compiled, Python imported."""
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as name:
        made = Path(name) / f"{source.stem}{'.cpp' if source.suffix == '.cpp' else '.py'}"
        made.write_text(code)
        if source.suffix != ".cpp":
            error = runpy.run_path(str(made))["error"]
            return lambda both: np.array([error(one[:4], one[4:]) for one in both])
        library = made.with_suffix(".so")
        subprocess.run([*COMPILE, *options, made, "-o", library, "-lorocos-kdl"], check=True)
        function = ctypes.CDLL(str(library)).all_errors

    def errors(both: np.ndarray) -> np.ndarray:
        found = np.full((len(both), 3), np.nan)
        function(ctypes.c_int(len(both)), np.ascontiguousarray(both).ctypes, found.ctypes)
        return found

    return errors


def turns_of(both: np.ndarray) -> Rotation:
    """Return the rotations from now to the goal in the base frame."""
    goal, now = (Rotation.from_quat(one, scalar_first=True) for one in (both[:, :4], both[:, 4:]))
    return goal * now.inv()


def errors_of(one: AsShipped, turns: Rotation) -> np.ndarray:
    """Return the errors of our kernel, n x 3."""
    return np.array([one.error(tuple(q)) for q in turns.as_quat(canonical=True, scalar_first=True).tolist()])


def compare(one: AsShipped, source: Path, folder: Path, options: list[str]) -> dict:
    """Return the row of a controller."""
    template = source.read_text()
    marks = list(MARK.finditer(template))
    file = marks[-1]["file"]
    repository, _, revision = one.source.partition("@")
    row = {"name": one.name, "repository": repository, "commit": revision, "file": file}
    row["lines"] = ", ".join(f"{mark['first']}-{mark['last']}" for mark in marks if mark["file"] == file)
    try:
        theirs = built(source, filled(one, template, folder), options)
    except (ImportError, FileNotFoundError, subprocess.CalledProcessError) as error:
        return row | {"reason": f"not built: {type(error).__name__}"}
    both = pairs()
    turn = turns_of(both)
    ours = errors_of(one, turn)
    found = theirs(both)
    apart = np.linalg.norm(found - ours, axis=1)
    is_near = turn.magnitude() > NEAR_180_RAD
    row |= {"pairs": PAIRS, "difference": float(apart[~is_near].max()), "near_180": float(apart[is_near].max())}
    print(*row.values(), flush=True)
    return row | {"errors": found[KEPT].tolist()}


def kept(row: dict, earlier: list[dict]) -> dict:
    """Return the row, or where it was not built here the earlier one of the same lines at the same commit."""
    same = [one for one in earlier if all(one[key] == row[key] for key in ("name", "commit", "file", "lines"))]
    return same[0] if same and "reason" in row else row


def main() -> None:
    """Build and compare all of them."""
    parser = make_parser("restated", __doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="copies of the repositories, owner+name each")
    parser.add_argument("--include", action="append", default=[], metavar="DIR", help="more headers (pinocchio's)")
    asked = parser.parse_args()
    files = {source.stem.replace("_", "-"): source for source in SOURCES.iterdir()}
    options = [f"-I{one}" for one in (SOURCES, *asked.include)]
    earlier = read_json(RESTATED)["controllers"]
    rows = [
        kept(compare(one, files[name], asked.folder, options), earlier) for name, one in contenders("shipped").items()
    ]
    write_json(RESTATED, {"controllers": rows, "provenance": describe_study("restated FOLDER")})


if __name__ == "__main__":
    main()

"""Run laws that lie through every command that executes a law, and compare what is left of the others.

Each way must end with another code than 0 and without a traceback, leave the rows of the other laws as they are
without it, and do the same when the command is given again.
"""

import subprocess
import tempfile
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path

from bench.base.processes import module_command
from bench.base.provenance import ROOT
from bench.experiments.tables.store import read

DATA = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
LAWS: dict[str, list[str]] = DATA["laws"]
OURS, SOUND = "rotation-matrix", "sound"


def write_law(folder: Path, name: str) -> Path:
    """Write the file of a law that lies, or of a sound one."""
    path, (answer, files) = folder / f"{name.replace('-', '_')}.py", LAWS.get(name, ("! pass", ""))
    text = DATA["head"] + DATA["loads" if answer.startswith("! ") else "lies"]
    for word, value in {"name": name, "origin": str(path), "answer": answer.removeprefix("! "), "files": files}.items():
        text = text.replace(f"{{{word}}}", value)
    path.write_text(text, encoding="utf-8")
    return path


def say(*words: object) -> dict:
    """Give a command, and return its code and what it printed."""
    done = subprocess.run(module_command("bench", *map(str, words)), cwd=ROOT, capture_output=True, text=True)
    said = done.stdout + done.stderr
    return {"code": done.returncode, "said": said[-600:], "traceback": "Traceback" in said}


def beside(folder: Path, names: Sequence[str], table: str, *words: object) -> dict[str, dict]:
    """Give a command with our law and a sound one, then twice with those that lie beside them."""
    found = {}
    for way, laws in {"alone": (), "beside": names, "again": names}.items():
        files = [word for name in (SOUND, *laws) for word in ("--law", write_law(folder, name))]
        out = folder / ("alone" if way == "alone" else "beside")
        found[way] = say(*words, "--regulator", OURS, *files, "--out", out)
        rows = read(out, table).astype({"regulator": str, "outcome": str})
        known = rows[rows["regulator"].isin((OURS, SOUND))].astype(object)
        found[way]["rows"] = known.to_json(orient="split", double_precision=15, index=False)
        found[way]["outcomes"] = {name: sorted({*rows.loc[rows["regulator"] == name, "outcome"]}) for name in laws}
    wanted = found.pop("alone")["rows"]
    return {way: one | {"same": one.pop("rows") == wanted} for way, one in found.items()}


def one_by_one(folder: Path, names: Sequence[str], words: str) -> dict[str, dict]:
    """Give a command for each law, and once more."""
    given = {f"{name}, {time}": name for name in names for time in ("once", "again")}
    return {each: say(*words.format(name=name, path=write_law(folder, name)).split()) for each, name in given.items()}


EPISODES = ("run", "--starts", "uniform", "--horizon", 0.02, "--count", 4, "--experiment", "free-body")
ON_ONE = (*EPISODES, "--engine", "ideal-rk4", "--law-limit", 5)
WAYS: dict[str, Callable[[Path, Sequence[str]], dict[str, dict]]] = {
    "run": lambda at, names: beside(at, names, "episodes", *ON_ONE),
    "local:2": lambda at, names: beside(at, names, "episodes", *ON_ONE, "--scheduler", "local:2"),
    "map": lambda at, names: beside(at, names, "map", "map", "--starts", 200, "--horizon", 0.02),
    "judge": lambda at, names: one_by_one(at, names, "judge {path}"),
    "export": lambda at, names: one_by_one(at, names, f"export {{name}} --law {{path}} --to c --out {at}/export"),
}


def is_well(found: dict[str, dict]) -> bool:
    """Tell whether a way ended as it must for every law."""
    return all(one["code"] in (1, 2) and not one["traceback"] and one.get("same", True) for one in found.values())


def go(way: str, names: Sequence[str]) -> dict:
    """Go a way with these laws, and return what became of them."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as here:
        return WAYS[way](Path(here), names)

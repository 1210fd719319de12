"""Run laws that lie through every command that executes a law, and compare what is left of the others.

    python -m bench.studies.survival.hostile                              all laws of hostile.toml, every command
    python -m bench.studies.survival.hostile --way judge --law bomb

Each way must end with another code than 0 and without a traceback, leave the rows of the other laws as they are
without it, and do the same when the command is given again.
"""

import contextlib
import io
import json
import sys
import tempfile
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path

from bench.cli import main as command
from bench.experiments.tables.store import read
from bench.studies.study import make_parser

LAWS: dict[str, list[str]] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["laws"]
OURS, SOUND = "rotation-matrix", "sound"
HEAD = """
import json, os, struct, sys, types
from bench.law import Law, kernel

@kernel
def law(R, omega, goal, gains):
    x = 0.5 * gains.kp * (R.o[2] - R.a[1]) + gains.kv * omega[0]
    y = 0.5 * gains.kp * (R.a[0] - R.n[2]) + gains.kv * omega[1]
    z = 0.5 * gains.kp * (R.n[1] - R.o[0]) + gains.kv * omega[2]
    return (-x, -y, -z)

REGULATOR = Law("{name}", "Mine", "none", "u", law)
ORIGIN = {origin!r}
"""
LIES = """
if "described" not in sys.argv[0]:
    import pyarrow as pa

    def put(t, half=False, **words):
        if not set(words) & set(t.schema.names):
            return t.slice(0, 0)
        for name, word in words.items():
            if name in t.schema.names:
                at, kind, kept = t.schema.get_field_index(name), t.schema.field(name).type, t.column(name).to_pylist()
                value = [word] * t.num_rows if not half else [word if i % 2 else w for i, w in enumerate(kept)]
                t = t.set_column(at, t.schema.field(name), pa.array(value, pa.string()).cast(kind) if word else
                                 pa.array(value, pa.string() if word == "" else None).cast(kind))
        return t

    def heading(t, **more):
        content = say(t)
        size, = struct.unpack_from("<I", content)
        text = json.dumps(json.loads(content[4 : 4 + size]) | more).encode()
        return struct.pack("<I", len(text)) + text + content[4 + size :]

    def stream(t):
        sink = pa.BufferOutputStream()
        with pa.ipc.new_stream(sink, t.schema) as out:
            out.write_table(t)
        return sink.getvalue().to_pybytes()

    def lie(t, kind):
        global say
        say = lambda table: honest(table, kind)
        made = {answer}
        return say(made) if isinstance(made, pa.Table) else made

    main = sys.modules["__main__"]
    if hasattr(main, "pack"):
        honest, main.pack = main.pack, lie
    if hasattr(main, "find_language"):
        main.find_language = lambda word: types.SimpleNamespace(files=lambda subject: {files})
"""


def write_law(folder: Path, name: str) -> Path:
    """Write the file of a law that lies, or of a sound one."""
    path, text = folder / f"{name.replace('-', '_')}.py", HEAD
    if name != SOUND:
        answer, files = LAWS[name]
        loads = f'if "described" not in sys.argv[0]:\n    {answer[2:]}\n'
        text += loads if answer.startswith("! ") else LIES.replace("{answer}", answer).replace("{files}", files)
    path.write_text(text.replace("{name}", name).replace("{origin!r}", repr(str(path))), encoding="utf-8")
    return path


def say(*words: object) -> dict:
    """Give a command, and return its code, what it printed, and what it raised."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = command([str(word) for word in words])
    except Exception as error:
        return {"code": None, "raised": repr(error)[:200]}
    return {"code": code, "said": said.getvalue()[-600:]} | (
        {"raised": "out"} if "Traceback" in said.getvalue() else {}
    )


def rows_of(out: Path, table: str, laws: Sequence[str]) -> str:
    """Return the rows of some laws as text, every digit of them."""
    found = read(out, table)
    return found[found["regulator"].isin(laws)].astype(object).to_json(orient="split", double_precision=15)


def beside(folder: Path, names: Sequence[str], table: str, *words: object) -> dict[str, dict]:
    """Give a command with our law and a sound one, with those that lie beside them, and once more."""
    files = {name: ("--law", write_law(folder, name)) for name in (SOUND, *names)}
    asked = (*words, "--regulator", OURS)
    first = say(*asked, *files[SOUND], "--out", folder / "alone")
    every = [word for pair in files.values() for word in pair]
    codes = [say(*asked, *every, "--out", folder / "beside")]
    for name in names:
        write_law(folder, name)  # one has edited itself
    codes.append(say(*asked, *every, "--out", folder / "beside"))
    same = rows_of(folder / "alone", table, (OURS, SOUND)) == rows_of(folder / "beside", table, (OURS, SOUND))
    theirs = read(folder / "beside", table).astype({"regulator": str, "outcome": str})
    lost = {name: sorted(set(theirs.loc[theirs["regulator"] == name, "outcome"])) for name in names}
    return {"alone": first, "beside": codes[0] | {"same": same, "outcomes": lost}, "again": codes[1]}


EPISODES = ("run", "--starts", "uniform", "--horizon", 0.02, "--count", 4, "--experiment", "free-body")
ON_ONE = (*EPISODES, "--engine", "ideal-rk4", "--law-limit", 5)


def one_by_one(folder: Path, names: Sequence[str], words: Callable[[str, Path], tuple]) -> dict[str, dict]:
    """Give a command for each law, and once more."""
    found = {}
    for name in names:
        found[name] = say(*words(name, write_law(folder, name)))
        found[f"{name}, again"] = say(*words(name, write_law(folder, name)))
    return found


def judge(folder: Path, names: Sequence[str]) -> dict[str, dict]:
    """Judge each law."""
    return one_by_one(folder, names, lambda name, path: ("judge", path))


def export(folder: Path, names: Sequence[str]) -> dict[str, dict]:
    """Export each law."""
    out = folder / "export"
    return one_by_one(folder, names, lambda name, path: ("export", name, "--law", path, "--to", "c", "--out", out))


WAYS: dict[str, Callable[[Path, Sequence[str]], dict[str, dict]]] = {
    "run": lambda folder, names: beside(folder, names, "episodes", *ON_ONE),
    "local:2": lambda folder, names: beside(folder, names, "episodes", *ON_ONE, "--scheduler", "local:2"),
    "map": lambda folder, names: beside(folder, names, "map", "map", "--starts", 200, "--horizon", 0.02),
    "judge": judge,
    "export": export,
}


def is_well(found: dict[str, dict]) -> bool:
    """Tell whether a way ended as it must for every law."""
    ended = [one for name, one in found.items() if name != "alone"]
    return all(one["code"] not in (0, None) and "raised" not in one and one.get("same", True) for one in ended)


def main(ways: Sequence[str], names: Sequence[str]) -> dict:
    """Go these ways with these laws, and return what became of them."""
    every = {}
    for way in ways:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as here:
            every[way] = WAYS[way](Path(here), names)
        print(f"{way}: {'well' if is_well(every[way]) else 'NOT WELL'}, {len(names)} laws", file=sys.stderr, flush=True)
    return every


if __name__ == "__main__":
    parser = make_parser("hostile", __doc__)
    parser.add_argument("--way", action="append", choices=[*WAYS], help="repeatable (default: all)")
    parser.add_argument("--law", action="append", choices=[*LAWS], help="repeatable (default: all)")
    options = parser.parse_args()
    json.dump(main(options.way or [*WAYS], options.law or [*LAWS]), sys.stdout, indent=1)

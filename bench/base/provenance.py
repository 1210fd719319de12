"""Record where numbers come from: sources, versions, machine, command; and where caches are kept."""

import contextlib
import functools
import hashlib
import importlib.metadata
import os
import platform
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from bench.base.errors import BadResults
from bench.base.files import read_json

ROOT = Path(__file__).resolve().parents[2]
"""The checkout, or the folder of installed packages."""
IS_CHECKOUT = (ROOT / "Makefile").is_file() and (ROOT / "pyproject.toml").is_file()
WORKPLACE = ROOT if IS_CHECKOUT else Path.cwd()
"""Results and caches go here; installed packages stay as they are."""
_ROOMS = ("base", "law", "audit", "translation", "engines", "experiments", "running")
DECIDING = ("tasks", *(f"bench/{room}" for room in _ROOMS))
"""What numbers of a run depend on; everything else only reads results, or is measured and kept apart from them."""
JUDGE = ("tasks/rules.py", "tasks/verdict.py", "tasks/truth.py", "tasks/cause.py")
"""What decides how a given motion is judged."""
VERSIONED = ("mujoco", "dm-control", "numpy", "scipy", "numba", "llvmlite", "pandas", "pyarrow")

TYPES: dict[str, type] = {
    **dict.fromkeys(("suite", "command", "commit", "judge", "platform", "cpu", "vectors", "finished"), str),
    **dict.fromkeys(("episodes", "trials", "troubled", "seed"), int),
    **{"dirty": bool, "versions": dict, "arithmetic": dict, "lost": list, "again": list, "wall_s": float},
}
"""Types of what is read of provenance.json; the entries of a dict or list are texts."""
MOST_SIGNS = 200
"""Longest text or number that is shown; a command may be longer."""


def read_provenance(folder: Path, needed: Iterable[str] = ()) -> dict:
    """Return provenance.json of a run, which may come from anywhere; BadResults if it is not as a run writes it."""
    path = folder / "provenance.json"
    found = read_json(path)
    if lacking := [name for name in needed if name not in found]:
        raise BadResults(f"{path}: it lacks {', '.join(lacking)}; delete the folder and run again")
    for name, kind in TYPES.items():
        value = found.get(name, kind())
        entries = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        is_typed = type(value) is kind or (kind is float and type(value) is int)
        is_long = not entries and name != "command" and len(str(value)) > MOST_SIGNS
        if is_long or not is_typed or not all(isinstance(one, str) for one in entries):
            wanted = f"{kind.__name__} of at most {MOST_SIGNS} signs" if is_long else kind.__name__
            raise BadResults(f"{path}: '{name}' is no {wanted}, as a run writes it; delete the folder and run again")
    return found


@functools.cache
def describe_project() -> dict[str, Any]:
    """Return version, dependencies and authors: of the checkout that runs, installed or not, else of the package."""
    if IS_CHECKOUT:
        project: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        return project
    said = importlib.metadata.metadata("orientation-bench")
    needs = [one for one in said.get_all("Requires-Dist") or [] if "extra ==" not in one]
    return {"version": said["Version"], "dependencies": needs, "authors": [{"name": said["Author"]}]}


@functools.cache
def source_digest() -> str:
    """Return sixteen hex digits over the code that results depend on, as first read, and versions of packages.

    Comments and docstrings are no code (sources.py).
    """
    from bench.base.sources import reader

    files = reader()
    paths = [path for name in DECIDING for path in files.list_files(name)]
    return files.digest(paths, repr(sorted(versions().items())))[:16]


@functools.cache
def everything_digest() -> str:
    """Return sixteen hex digits over every source, the versions of what they use, and how this processor rounds."""
    settings = [os.environ.get(name) for name in ARITHMETIC]
    return _digest(("bench", "tasks"), repr((sorted(versions().items()), vectors(), settings)))


def _digest(names: tuple[str, ...], more: str = "") -> str:
    digest = hashlib.sha256()
    for name in names:
        found = ROOT / name
        for path in sorted(found.rglob("*")) if found.is_dir() else [found]:
            if path.suffix in (".py", ".toml", ".xml", ".json"):
                digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    digest.update(more.encode())
    return digest.hexdigest()[:16]


def kept_in(variable: str, usual: str, instead: Path = WORKPLACE / ".home") -> Path:
    """Return our folder where a variable says, or at the usual place in HOME; else in .home of the checkout.

    Where none of them can be written, as under `docker run --user`, it is this user's own temporary folder, for
    compiled code lies in it.
    """
    named = os.environ.get(variable) or os.path.join(os.path.expanduser("~"), usual)
    for path in (Path(named), instead / usual):
        ours = path / "orientation-bench"
        with contextlib.suppress(OSError):
            if path.is_absolute():  # of a user without a name home is "~"
                ours.mkdir(parents=True, exist_ok=True)
            if os.access(ours, os.W_OK | os.X_OK):
                return ours
    own = Path(tempfile.gettempdir(), f"orientation-bench-{os.getuid()}")
    with contextlib.suppress(FileExistsError):
        own.mkdir(mode=0o700)
    is_ours = own.lstat().st_uid == os.getuid() and os.access(own, os.W_OK)
    os.environ[variable] = str(own) if is_ours else tempfile.mkdtemp(prefix="orientation-bench-")
    return kept_in(variable, usual, instead)


def versions() -> dict[str, str]:
    """Return the versions of Python and of the packages that results depend on."""
    return {"python": platform.python_version(), **{name: importlib.metadata.version(name) for name in VERSIONED}}


def _read_cpu(field: str) -> str:
    """Return a field of the first processor; empty where the system is silent."""
    info = Path("/proc/cpuinfo")
    text = info.read_text() if info.is_file() else ""
    return text.partition(f"\n{field}")[2].partition("\n")[0].partition(":")[2].strip()


def cpu_name() -> str:
    """Return the processor's name as the system gives it."""
    return _read_cpu("model name") or platform.processor() or platform.machine()


VECTORS = ("sse4_2", "avx", "avx2", "fma", "avx512f")
ARITHMETIC = ("OPENBLAS_CORETYPE", "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NPY_DISABLE_CPU_FEATURES", "GLIBC_TUNABLES")
"""Variables that make libraries round as on another processor."""


def vectors() -> str:
    """Which of VECTORS the processor has, by which libraries choose their kernels; empty where the system is silent."""
    return " ".join(word for word in VECTORS if word in _read_cpu("flags").split())


def rounded_on(origin: dict) -> str:
    """Return a run's processor, and what made its libraries round as on another one, in words; of its provenance."""
    settings = [f"{name}={value}" for name, value in origin.get("arithmetic", {}).items()]
    return ", ".join(filter(None, (*(origin.get(name, "") for name in ("cpu", "vectors")), *settings)))


def machine_key() -> str:
    """Return a short, stable name of this kind of machine: processor and cores, nothing that identifies it."""
    words = "".join(c if c.isalnum() else "-" for c in f"{cpu_name()}-{os.cpu_count()}-cores".lower())
    return "-".join(part for part in words.split("-") if part)


def commit() -> dict:
    """Return the commit of the checkout and whether it had changes; empty outside git."""
    try:
        head = _git("rev-parse", "HEAD")
        return {"commit": head, "dirty": bool(_git("status", "--porcelain", "--", "bench", "tasks"))}
    except (OSError, subprocess.CalledProcessError):
        return {"commit": "", "dirty": False}


def _git(*words: str) -> str:
    return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=True).stdout.strip()


def _without_folders(word: str) -> str:
    """Return a word of the command line without folders outside this checkout and without hosts."""
    scheme, is_address, _ = word.partition("://")
    if is_address:
        return f"{scheme}://..."
    path = Path(word)
    if not path.is_absolute():
        return word
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name


def describe() -> dict:
    """Describe this moment; lock: SHA-256 of requirements/base.txt, empty where the package lies without it."""
    lock = ROOT / "requirements" / "base.txt"
    return {
        **commit(),
        "sources": source_digest(),
        "judge": _digest(JUDGE),
        "versions": versions(),
        "lock": hashlib.sha256(lock.read_bytes()).hexdigest() if lock.is_file() else "",
        "platform": " ".join((platform.system(), platform.machine(), *platform.libc_ver())).strip(),
        "cpu": cpu_name(),
        "vectors": vectors(),
        "arithmetic": {name: os.environ[name] for name in ARITHMETIC if os.environ.get(name)},
        "cores": os.cpu_count(),
        "command": " ".join(["bench", *map(_without_folders, sys.argv[1:])]),
    }

"""The folder of a run that is not finished yet: what is done in it, one file a unit, so that it can go on.

Layout: plan.json first, and laws/ with the user's own; then parts/<unit>.rows one by one; at the end the tables,
provenance.json last of all, and the parts go (run.py).
"""

import contextlib
import dataclasses
import hashlib
import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa

from bench.base.errors import BadResults
from bench.base.files import is_leftover, make_folder, read_json, refuse_link, refused, write_atomically, write_json
from bench.base.lock import lock_folder
from bench.base.provenance import read_provenance
from bench.experiments.experiment import Unit, experiment_of, known_experiments
from bench.experiments.plan import Plan, digest_of
from bench.experiments.tables import packed, trust
from bench.experiments.tables.store import check


class FolderState(NamedTuple):
    """What a results folder holds of a plan; spoiled: units whose parts are not as a run of it wrote them."""

    finished: bool
    done: frozenset[str]
    spoiled: tuple[Unit, ...] = ()


@contextlib.contextmanager
def open_run_folder(out: Path) -> Iterator[None]:
    """Keep other runs out of the folder, made if there is none and never left empty; BadResults if one is at work."""
    is_new = not out.exists()
    with contextlib.ExitStack() as stack:
        try:
            make_folder(out)
            stack.enter_context(lock_folder(out))
        except OSError as error:
            raise refused(out, error) from error
        try:
            yield
        finally:
            if is_new and not any(out.iterdir()):
                out.rmdir()


def inspect(plan: Plan, out: Path, replace: bool = False) -> FolderState:
    """Return which units are finished in `out`, and change nothing there; BadResults for a foreign folder.

    A folder is foreign if it holds another plan, or files that no run of ours has made.
    """
    out = Path(out)
    if not _content(out):
        return FolderState(False, frozenset())
    for path in _content(out):
        refuse_link(path)
    if not (out / "plan.json").is_file():
        raise BadResults(f"{out}: the folder holds something else than a run of ours; choose another with --out")
    content = read_json(out / "plan.json")
    found = content.pop("digest", None)
    if found is None:
        raise BadResults(f"{out}: its plan.json is none of ours; choose another folder with --out")
    is_whole = found == digest_of(content)
    if not is_whole or found != plan.digest:
        if replace:
            return FolderState(False, frozenset())
        is_other = f"holds another plan ({describe_difference(content, plan.identity())})"
        was_changed = "has a plan.json that was edited or damaged: its digest is not that of what it says"
        raise BadResults(
            f"{out}: it {is_other if is_whole else was_changed}; add --replace to start over or choose another folder "
            "with --out"
        )
    tables = {out / f"{name}.parquet": table for name, table in plan.tables.items()}
    has_ended = (out / "provenance.json").is_file() and all(path.is_file() for path in tables)
    finished = has_ended and not read_provenance(out).get("again")
    for path, table in tables.items() if finished else ():
        check(path, table)
    if finished:
        return FolderState(True, frozenset(unit.key for unit in plan.units))
    found = [unit for unit in plan.units if os.path.lexists(part(out, unit))]
    done = frozenset(unit.key for unit in found if is_sound(plan, out, unit))
    return FolderState(False, done, tuple(unit for unit in found if unit.key not in done))


def describe_difference(kept: dict, wanted: dict) -> str:
    """Say in which fields the identity of a plan that a folder keeps differs from the wanted one."""
    now = json.loads(json.dumps(wanted))
    long = {"own": "other law files"} | {one: f"other {one}" for one in ("units", "arms", "rules", "sources")}
    names = [name for name in now if kept.get(name) != now[name]]
    said = (long.get(name) or f"{name} {kept.get(name)!s:.60} there, {now[name]} here" for name in names)
    return ", ".join(said).replace("_", " ") or "its digest alone"


def part(out: Path, unit: Unit) -> Path:
    """Return the file of a unit that is done."""
    return out / "parts" / f"{unit.key}.rows"


SEAL = hashlib.sha256().digest_size
"""Bytes at the beginning of a part: the digest of its plan (request, rules, sources), its unit and its rows."""


def _seal(plan: Plan, unit: Unit, content: bytes) -> bytes:
    words = f"{plan.digest} {dataclasses.astuple(unit)!r} "
    return hashlib.sha256(words.encode() + content).digest()


def write_part(plan: Plan, out: Path, unit: Unit, content: bytes) -> None:
    """Keep the rows of a unit (packed.py), bound to the plan."""
    sealed = _seal(plan, unit, content) + content
    write_atomically(part(out, unit), lambda temporary: Path(temporary).write_bytes(sealed))


def is_sound(plan: Plan, out: Path, unit: Unit) -> bool:
    """Tell whether a part is, to the last bit, what a run of this plan wrote for this unit."""
    path = part(out, unit)
    refuse_link(path)
    content = path.read_bytes()
    return content[:SEAL] == _seal(plan, unit, content[SEAL:])


def read_part(plan: Plan, out: Path, unit: Unit) -> pa.Table:
    """Return the rows of a part; BadResults if it is not as it was written."""
    path = part(out, unit)
    if not path.is_file() or not is_sound(plan, out, unit):
        raise BadResults(f"{path}: it was removed or changed while the run went on; give the same command again")
    return packed.unpack(path.read_bytes()[SEAL:], experiment_of(unit).table)


def _content(out: Path) -> list[Path]:
    """Return what lies in a folder, leftovers of killed writes apart; nothing if there is no folder yet."""
    try:
        return [path for path in out.iterdir() if not is_leftover(path)]
    except FileNotFoundError:
        return []
    except OSError as error:
        raise BadResults(f"{out}: cannot be used as a folder ({error.strerror}); choose another with --out") from error


def begin(plan: Plan, out: Path) -> None:
    """Make the folder this plan's, whatever of ours it held."""
    _clear(out)
    write_json(out / "plan.json", {"digest": plan.digest, **plan.identity()})
    for own in plan.request.user_laws:  # so that its rows can be read, and its report written, with what made them
        copy = out / "laws" / f"{own.name.replace('-', '_')}.py"
        write_atomically(copy, lambda temporary, own=own: Path(temporary).write_bytes(own.text.encode()))
        with contextlib.suppress(OSError):  # without it the report shows the law's rows, and asks to trust it
            trust.remember(own.text.encode())


def _clear(out: Path) -> None:
    """Remove an earlier run of ours, plan.json last, so that a kill in between leaves a folder we recognise."""
    if not out.is_dir():
        return
    with _removing(out):
        (out / "provenance.json").unlink(missing_ok=True)
        for one in known_experiments().values():
            (out / f"{one.table.name}.parquet").unlink(missing_ok=True)
        if (out / "laws").is_dir():
            shutil.rmtree(out / "laws")
        tidy(out)
        (out / "plan.json").unlink(missing_ok=True)


def tidy(out: Path) -> None:
    """Remove what only an unfinished run needs: its parts, and the temporary files of killed writes."""
    with _removing(out):
        if (out / "parts").is_dir():
            shutil.rmtree(out / "parts")
    sweep(out)


def sweep(out: Path) -> None:
    """Remove the temporary files of killed writes, which may be what fills the disk."""
    with _removing(out):
        folders = [folder for folder in (out, out / "parts", out / "laws") if folder.is_dir()]
        for path in [path for folder in folders for path in folder.iterdir() if is_leftover(path)]:
            path.unlink(missing_ok=True)


@contextlib.contextmanager
def _removing(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise BadResults(
            f"{out}: cannot be emptied ({error.strerror}); check its permissions, or choose another folder with --out"
        ) from error

"""The folder of a run that is not finished yet: what is done in it, one file a unit, so that it can go on.

Layout: plan.json first, and laws/ with the user's own; then parts/<unit>.parquet one by one; at the end the tables,
provenance.json last of all, and the parts go (`finish`).
"""

import contextlib
import functools
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from bench.base import lock
from bench.base.errors import BadResults
from bench.base.files import is_leftover, make_folder, read_json, refuse_link, refused, write_atomically, write_json
from bench.experiments.experiment import Unit, experiment_of, known_experiments
from bench.experiments.plan import Plan
from bench.experiments.tables import trust
from bench.experiments.tables.store import check


class State(NamedTuple):
    """What a results folder holds of a plan."""

    finished: bool
    done: frozenset[str]


@contextlib.contextmanager
def held(out: Path) -> Iterator[None]:
    """Keep other runs out of the folder, which is made if there is none, and not left behind empty.

    Errors:
        BadResults: another run is at work there, or it is no folder, or cannot be made.
    """
    is_new = not out.exists()
    with contextlib.ExitStack() as stack:
        try:
            make_folder(out)
            stack.enter_context(lock.held(out))
        except OSError as error:
            raise refused(out, error) from error
        try:
            yield
        finally:
            if is_new and not any(out.iterdir()):
                out.rmdir()


def inspect(plan: Plan, out: Path, replace: bool = False) -> State:
    """Return what is done already in `out`; nothing is touched.

    Errors:
        BadResults: the folder holds another plan, or something that is no run of ours.
    """
    out = Path(out)
    if not _content(out):
        return State(False, frozenset())
    for path in _content(out):
        refuse_link(path)
    if not (out / "plan.json").is_file():
        raise BadResults(f"{out}: the folder holds something else than a run of ours; choose another with --out")
    found = read_json(out / "plan.json").get("digest")
    if found is None:
        raise BadResults(f"{out}: its plan.json is none of ours; choose another folder with --out")
    if found != plan.digest():
        if replace:
            return State(False, frozenset())
        raise BadResults(
            f"{out}: it holds another plan (other suite, options, rules or sources); add --replace to start over, or "
            "choose another folder with --out"
        )
    tables = {out / f"{name}.parquet": table for name, table in plan.tables.items()}
    finished = (out / "provenance.json").is_file() and all(path.is_file() for path in tables)
    for path, table in tables.items() if finished else ():
        check(path, table)
    done = [unit for unit in plan.units if part(out, unit).is_file()]
    for unit in () if finished else done:
        check(part(out, unit), experiment_of(unit).table)
    return State(finished, frozenset(unit.key for unit in done))


def part(out: Path, unit: Unit) -> Path:
    """Return the file of a unit that is done."""
    return out / "parts" / f"{unit.key}.parquet"


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
    write_json(out / "plan.json", {"digest": plan.digest(), **plan.identity()})
    _keep_own_laws(plan, out)


def _keep_own_laws(plan: Plan, out: Path) -> None:
    """Copy a user's laws into the run, so that its rows can be read, and its report written, with what made them."""
    for own in plan.settings.own:
        copy = out / "laws" / f"{own.name.replace('-', '_')}.py"
        write_atomically(copy, functools.partial(shutil.copyfile, own.origin))
        with contextlib.suppress(OSError):  # without it the report shows the law's rows, and asks to trust it
            trust.remember(copy.read_bytes())


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

"""python -m bench.studies.libraries [NAME ...]: ask every library installed here, or those named; results/libraries.

Rows of libraries that are not asked stay as they are, so that one which needs an environment of its own adds its own.
"""

import argparse
import platform
from importlib.metadata import version

import pandas as pd

from bench.errors import UnknownWord
from bench.provenance import cpu_name
from bench.studies.libraries.found import find, version_of
from bench.studies.libraries.judge import judge
from bench.studies.libraries.library import Library
from bench.studies.libraries.turns import TurnSet, every_set
from bench.tables.files import read_json, write_json
from bench.tables.schema import RESULTS
from bench.tables.store import read, write_table

FOLDER = RESULTS / "libraries"


def main() -> None:
    """Ask, and put the answers in the place of earlier ones."""
    parser = argparse.ArgumentParser(prog="python -m bench.studies.libraries", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="only this library; repeatable")
    names = parser.parse_args().names
    found = find()
    by_name = {one.name: one for one in found.libraries}
    for name in names:
        if name not in by_name:
            raise UnknownWord("library", name, sorted(by_name))
    for name, reason in found.missing.items():
        print(f"{name}: not asked ({reason})")
    chosen = [by_name[name] for name in names] or list(found.libraries)
    sets = every_set()
    frames, about = [], {}
    for library in chosen:
        print(f"{library.name} {version_of(library)}: {len(library.functions)} functions")
        frames.append(rows(library, sets))
        about[library.name] = origin(library)
    keep(pd.concat(frames), about)


def rows(library: Library, sets: tuple[TurnSet, ...]) -> pd.DataFrame:
    """One library's rows of libraries.parquet."""
    return pd.DataFrame(
        {
            "library": library.name,
            "version": version_of(library),
            "function": function.name,
            "takes": function.takes,
            "form": function.form,
            "turn_set": one.name,
            "angle_rad": one.angle_rad,
            "distance_rad": one.distance_rad,
            **judge(function, one),
        }
        for function in library.functions
        for one in sets
    )


def origin(library: Library) -> dict:
    """With what a library was asked."""
    return {
        "version": version_of(library),
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "platform": " ".join((platform.system(), platform.machine(), *platform.libc_ver())).strip(),
        "cpu": cpu_name(),
    }


def keep(new: pd.DataFrame, about: dict) -> None:
    """Write the table and provenance.json, with what other libraries answered earlier."""
    if (FOLDER / "provenance.json").is_file():
        earlier = read(FOLDER, "libraries")
        new = pd.concat([earlier[~earlier["library"].isin(about)].astype({"library": str}), new])
        about = read_json(FOLDER / "provenance.json")["libraries"] | about
    order = new["library"].astype(str).str.lower()
    new = new.assign(order=order).sort_values("order", kind="stable").drop(columns="order")
    write_table(FOLDER / "libraries.parquet", new.reset_index(drop=True), "libraries")
    write_json(FOLDER / "provenance.json", {"libraries": about})
    print(f"wrote {FOLDER.relative_to(RESULTS.parent)}: {len(new)} rows, {new['library'].nunique()} libraries")


if __name__ == "__main__":
    main()

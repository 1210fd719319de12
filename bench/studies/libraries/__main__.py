"""python -P -m bench.studies.libraries [NAME ...]: ask every library installed here, or those named; results/libraries.

A NAME is a function of asked/. Rows of libraries that are not asked stay as they are, so that one which needs an
environment of its own adds its own; what a new version has fixed is marked.
"""

import datetime
import platform
from importlib.metadata import version
from operator import itemgetter
from pathlib import Path

import pandas as pd

from bench.base.files import read_json, write_json
from bench.base.provenance import cpu_name
from bench.experiments.tables.store import read, write_table
from bench.findings.libraries import SINGLE_RAD, STUDY
from bench.studies.libraries.asked import find, version_of
from bench.studies.libraries.closed_loop import rows_of
from bench.studies.libraries.judge import COUNT_RAD, judge
from bench.studies.libraries.library import ANGLES, Library
from bench.studies.libraries.turns import TurnSet, every_set
from bench.studies.libraries.upstream import check_patches
from bench.studies.libraries.verdict import verdict
from bench.studies.study import make_parser


def main() -> None:
    """Ask, and put the answers in the place of earlier ones."""
    parser = make_parser("libraries", __doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="only this library; repeatable")
    found = find(*parser.parse_args().names)
    for name, reason in found.missing.items():
        print(f"{name}: not asked ({reason})")
    sets = every_set()
    frames: dict[str, list[pd.DataFrame]] = {"libraries": [], "closed_loop": [], "verdicts": []}
    about, patches = dict[str, dict](), dict[str, dict]()
    for library in found.libraries:
        print(f"{library.name} {version_of(library)}: {len(library.functions)} functions", flush=True)
        if not library.is_restated:
            frames["libraries"].append(rows(library, sets))
            about[library.name] = origin(library)
        frames["closed_loop"].append(closed_loops(library))
        frames["verdicts"].append(verdicts(library))
        patches |= check_patches(library)
    keep_patches(patches)
    keep({name: pd.concat(own) for name, own in frames.items() if own}, about)


def rows(library: Library, sets: tuple[TurnSet, ...]) -> pd.DataFrame:
    """One library's rows of libraries.parquet."""
    return pd.DataFrame(
        {
            "library": library.name,
            "version": version_of(library),
            "function": function.name,
            "kind": function.kind,
            "takes": function.takes,
            "form": function.form,
            "precision": "single" if library.is_single else "double",
            "thread": function.thread,
            "turn_set": one.name,
            "angle_rad": one.angle_rad,
            "distance_rad": one.distance_rad,
            **judge(function, one, SINGLE_RAD if library.is_single else COUNT_RAD),
        }
        for function in library.functions
        for one in sets
    )


def closed_loops(library: Library) -> pd.DataFrame:
    """One library's rows of closed_loop.parquet, of all but angles; where anybody servos on those, by a controller."""
    found = []
    for one in library.functions:
        if one.form == ANGLES:
            continue
        kind = "restated" if library.is_restated else one.kind
        found += [(one.name, kind, "", one.name, "acceleration", row) for row in rows_of(one)]
    for loop in library.controllers:
        kind = "our-loop" if loop.is_our_loop else "controller"
        found += [(loop.name, kind, loop.title, loop.error, loop.command, row) for row in rows_of(loop)]
    whose = {"library": library.name, "version": version_of(library)}
    names = ("function", "kind", "title", "error", "command")
    return pd.DataFrame(whose | dict(zip(names, words, strict=True)) | row for *words, row in found)


def verdicts(library: Library) -> pd.DataFrame:
    """One library's rows of verdicts.parquet, not yet marked."""
    errors = [one for one in library.functions if one.form != ANGLES]
    whose = {"library": library.name, "version": version_of(library), "fixed": "", "fixed_since": ""}
    return pd.DataFrame(whose | {"function": one.name} | verdict(one) for one in errors)


def origin(library: Library) -> dict:
    """With what a library was asked."""
    return {
        "version": version_of(library),
        "asked": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "note": library.note,
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "platform": " ".join((platform.system(), platform.machine(), *platform.libc_ver())).strip(),
        "cpu": cpu_name(),
    }


def keep(tables: dict[str, pd.DataFrame], about: dict[str, dict]) -> None:
    """Write the tables and provenance.json, with the earlier rows of libraries that were not asked."""
    for name, new in tables.items():
        if (STUDY / f"{name}.parquet").is_file():
            earlier = read(STUDY, name)
            earlier = earlier.astype(dict.fromkeys(earlier.select_dtypes("category"), str))
            if name == "verdicts":
                new = marked(new, earlier)
            new = pd.concat([earlier[~earlier["library"].isin(new["library"])], new])
        new = new.sort_values("library", key=lambda names: names.str.lower(), kind="stable", ignore_index=True)
        write_table(STUDY / f"{name}.parquet", new, name)
        print(f"wrote {name}: {len(new)} rows, {new['library'].nunique()} libraries")
    if (STUDY / "provenance.json").is_file():
        about = read_json(STUDY / "provenance.json")["libraries"] | about
    write_json(STUDY / "provenance.json", {"libraries": about})


def keep_patches(checked: dict[str, dict]) -> None:
    """Print which patches are fixed in the installed libraries; write patches.json, with what was checked earlier."""
    kept = (read_json(STUDY / "patches.json") if (STUDY / "patches.json").is_file() else {}) | checked
    for patch in sorted(path.stem for path in Path(__file__).parent.glob("patches/*.patch")):
        text = "not checked: needs its library, or the source that its test runs on"
        print(f"patch {patch}:", "{state} in {version}".format_map(kept[patch]) if patch in kept else text)
    write_json(STUDY / "patches.json", kept)


def marked(new: pd.DataFrame, earlier: pd.DataFrame) -> pd.DataFrame:
    """Mark new verdicts with the faults that an earlier version had and this one has not, and with that version."""
    place_of = itemgetter("library", "function", "takes")
    before = {place_of(row): row for row in earlier.to_dict("records")}
    rows = new.to_dict("records")
    for row in rows:
        old = before.get(place_of(row), row)
        if old["version"] == row["version"]:
            row |= {"fixed": old["fixed"], "fixed_since": old["fixed_since"]}
            continue
        gone = sorted({*old["faults"].split(", ")} - {*row["faults"].split(", "), ""})
        row |= {"fixed": ", ".join(gone), "fixed_since": old["version"] if gone else ""}
        if gone:
            print(f"fixed in {row['library']} {row['version']}: {row['function']}: {row['fixed']}")
    return pd.DataFrame(rows)


if __name__ == "__main__":
    main()

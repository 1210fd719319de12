"""Build the report: results in, HTML out, offline, warnings as errors.

    make report                                    from results/latest, else results/reference
    ORIENTATION_BENCH_RESULTS=DIR make report      from another results folder
    make report ARGS=--pdf                         also the front page and the chapters as one PDF

Neither Sphinx nor the execution cache notices changed data or modules, so this file keys both. `site`
digests all that can change a page; equal to the finished build's, there is nothing to do. `cells` leaves
out the text of the pages: while it stays, cells keep their stored outputs (jupyter-cache compares the
cells' own text); when it moves, every cell runs again.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

import book_pdf
import check_site
import subjects

from bench.__main__ import SETTINGS
from bench.cli.progress import progress
from bench.experiments.tables import data_package, trust

REPORT = Path(__file__).resolve().parent
ROOT = REPORT.parent
BUILD = REPORT / "_build"
SITE = BUILD / "html"
CELL_CACHE = BUILD / ".jupyter_cache"
CELL_KEY = BUILD / "cells.key"
STAMP = BUILD / "finished.json"
RESULTS_VARIABLE, BLAS = "ORIENTATION_BENCH_RESULTS", "OPENBLAS_NUM_THREADS"
# What cells read and run besides a run's folder.
BEHIND_CELLS = ("results/timings", "results/libraries", "bench", "report/figures", "tasks", "requirements")
FILES_BEHIND_CELLS = ("pyproject.toml", "CITATION.cff", "report/subjects.py", "report/subjects.toml")
WRITTEN_LAST = "provenance.json"  # a run without it is unfinished
NO_GIT_EPOCH = 1_793_491_200  # 2026-11-01, the date printed by a copy without git history
# It has no __main__, and its script in bin names the folder it was installed in.
JUPYTER_BOOK = "from jupyter_book.cli.main import main; main()"
MOST_COMPLAINTS = 80  # lines shown of a failed build
TERMINAL_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
# Not the kernel's own lines, which say "WARNING | ...":
PROBLEM = re.compile(r"\b(WARNING|ERROR|CRITICAL|SEVERE)\b(?! \|)")
DATA_LINK = re.compile(r'href="(?:\.\./)?data/([\w./-]+)"')
CELL_RAISED = "An error occurred while executing the following cell"


class CannotBuild(Exception):
    """The report cannot be built; the message says why and what to do."""


def results_folder(root: Path = ROOT) -> Path:
    """Return the folder of results the pages read: the environment's, else latest, else reference."""
    named = os.environ.get(RESULTS_VARIABLE)
    if named:
        folder = Path(named).expanduser().resolve()
        if not (folder / WRITTEN_LAST).is_file():
            raise CannotBuild(
                f"{RESULTS_VARIABLE} names {folder}, which holds no {WRITTEN_LAST}, so no finished run "
                "(cure: name the folder of a finished run, or unset the variable)"
            )
        return without_links(folder)
    for name in ("latest", "reference"):
        if (root / "results" / name / WRITTEN_LAST).is_file():
            return without_links(root / "results" / name)
    raise CannotBuild(
        "neither results/latest nor results/reference holds a finished run (cure: make bench, then make report)"
    )


def without_links(folder: Path) -> Path:
    """Return the folder, if all in it lies there itself: a link would show, and offer, a file of this machine."""
    for path in folder.rglob("*"):
        if path.is_symlink():
            raise CannotBuild(f"{path} is a link (cure: put what it leads to in its place, if you trust it)")
    return folder


def files_below(folder: Path) -> Iterator[Path]:
    """Every file of a folder that is source, in a fixed order: caches and builds left out."""
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder).parts
        if path.is_file() and not any(part.startswith((".", "_build", "__pycache__")) for part in inside):
            yield path


def digest(paths: Iterable[Path], root: Path) -> str:
    """One digest of the bytes of these files and of their names below the root."""
    total = hashlib.sha256(sys.version.encode())
    for path in paths:
        total.update(f"\0{os.path.relpath(path, root)}\0".encode())
        total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()


def keys(results: Path, root: Path = ROOT) -> dict[str, str]:
    """Digests of what the cells read and run, and of all that a page is made of."""
    marks = (trust.mark(path.read_bytes()) for path in sorted(results.glob("laws/*.py")))
    behind_cells = [
        *files_below(results),
        *(mark for mark in marks if mark.is_file()),
        *(path for name in BEHIND_CELLS for path in files_below(root / name)),
        *(root / name for name in FILES_BEHIND_CELLS if (root / name).is_file()),
    ]
    of_site = [*behind_cells, *files_below(root / "report")]
    return {"cells": digest(behind_cells, root), "site": digest(of_site, root)}


def date_of_commit() -> str:
    """Seconds since 1970 of the last commit: the date on the pages, so that equal input gives equal bytes."""
    command = ["git", "log", "-1", "--format=%ct"]
    try:
        asked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return str(NO_GIT_EPOCH)
    return asked.stdout.strip() or str(NO_GIT_EPOCH)


def environment(results: Path) -> dict[str, str]:
    """Return what the build and its kernels see: this interpreter first, the results, a fixed clock."""
    ours = {
        **os.environ,
        RESULTS_VARIABLE: str(results),
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")]),
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH", "")])),
        "PYTHONHASHSEED": "0",
        "PYDEVD_DISABLE_FILE_VALIDATION": "1",  # else the kernel's debugger writes a line to stderr
        BLAS: os.environ.get(BLAS, SETTINGS[BLAS]),  # threads of matrices wait at full speed
        "JUPYTER_PREFER_ENV_PATH": "1",  # this environment's kernel, whatever the user has at home
        "NO_COLOR": "1",
    }
    ours.setdefault("SOURCE_DATE_EPOCH", date_of_commit())
    return ours


def build(results: Path, cell_key: str) -> None:
    """Run jupyter-book on a clean output folder, and the cells that changed; raise CannotBuild with what was said.

    The pages are always read again (Sphinx repeats no warning for a page it skips).
    """
    STAMP.unlink(missing_ok=True)
    BUILD.mkdir(exist_ok=True)
    cells_are_fresh = CELL_KEY.is_file() and CELL_KEY.read_text(encoding="utf-8") == cell_key
    for stale in (SITE, BUILD / ".doctrees", *([] if cells_are_fresh else [CELL_CACHE])):
        shutil.rmtree(stale, ignore_errors=True)
    CELL_KEY.write_text(cell_key, encoding="utf-8")
    strict = ["-W", "-n", "--keep-going", "-q"]
    command = [sys.executable, "-c", JUPYTER_BOOK, "build", ".", *strict]
    log = BUILD / "build.log"
    with log.open("w", encoding="utf-8") as output, progress("pages", "building the pages"):
        done = subprocess.run(
            command, cwd=REPORT, env=environment(results), stdout=output, stderr=subprocess.STDOUT, check=False
        )
    if done.returncode:
        said = "\n".join(complaints(log.read_text(encoding="utf-8")))
        raise CannotBuild(f"the pages do not build:\n{said}\nreport: all that was said is in {log}")


def offer_data(results: Path, site: Path = SITE) -> None:
    """Put beside the pages what they link to as data/...: the run's files and descriptor, this checkout's timings."""
    pages = [page.read_text(encoding="utf-8") for page in site.rglob("*.html")]
    names = sorted({name for page in pages for name in DATA_LINK.findall(page)})
    for name in names:
        source = ROOT / "results" / name if name.startswith("timings/") else results / name
        if source.is_file() and ".." not in Path(name).parts:  # a link to nothing is the page check's to report
            target = site / "data" / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
    if data_package.NAME in names and any(results.glob("*.parquet")):
        (site / "data" / data_package.NAME).write_text(data_package.written(results), encoding="utf-8")


def complaints(log: str) -> list[str]:
    """Return the lines of a failed build that say what is wrong: warnings, errors, and the cell that raised."""
    kept, in_cell = [], False
    for line in TERMINAL_COLOUR.sub("", log).splitlines():
        if line.startswith("Exception occurred"):  # here the log says it all a second time
            break
        if CELL_RAISED in line:
            in_cell = True
        elif line.startswith(("Traceback", "The above exception")):
            in_cell = False
        if in_cell or PROBLEM.search(line):
            kept.append(line)
    return kept[:MOST_COMPLAINTS] or log.splitlines()[-MOST_COMPLAINTS:]


def parse_arguments() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(description="Build the report from the results of a run.")
    parser.add_argument("--pdf", action="store_true", help="also print the chapters as one PDF (needs chromium)")
    return parser.parse_args()


def main() -> int:
    """Build if anything changed, check the pages, say where they are."""
    began, asked = time.monotonic(), parse_arguments()
    try:
        results = results_folder()
        print(f"report: from {os.path.relpath(results, ROOT)}", flush=True)
        if faults := subjects.find_faults(subjects.read_pages(subjects.MAP), subjects.list_pages()):
            raise CannotBuild("\n".join(faults))
        is_built = STAMP.is_file() and (SITE / "index.html").is_file()
        wanted, finished = keys(results), json.loads(STAMP.read_text(encoding="utf-8")) if is_built else {}
        if wanted != finished:
            build(results, wanted["cells"])
            offer_data(results)
        if asked.pdf:
            print(f"report: {book_pdf.write_pdf(SITE, environment(results)['SOURCE_DATE_EPOCH'])}", flush=True)
        problems = check_site.find_problems(SITE)
        if problems:
            raise CannotBuild("\n".join([*problems, f"the page check found {len(problems)} problems"]))
    except CannotBuild as reason:
        print(f"report: {reason}", file=sys.stderr)
        return 2
    STAMP.write_text(json.dumps(wanted), encoding="utf-8")
    state = "nothing changed" if wanted == finished else "built"
    print(f"report: {state}, {check_site.summary(SITE)}, in {time.monotonic() - began:.1f} s")
    print(f"report: open {SITE / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Kill commands in each of their phases, give them again, and compare what they end with: results/survival."""

import shutil
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path

from bench.base import files
from bench.base.provenance import ROOT, describe
from bench.studies.study import make_parser
from bench.studies.survival.aimed import Aim, kill_evenly, leave_alone
from bench.studies.survival.traced import COMPILING, FINISH, MERGE, PARTS, START

LOCAL = "local:2"
RUN = (
    "run --suite quick --regulator rotation-matrix --engine ideal-rk4 --experiment free-body --count 4 --workers 1 "
    "--out {out}"
)
"""One law on the free body: eight units."""
MAP = "map --regulator rotation-matrix --starts 10000 --workers 1 --out {out}"
AIMS = (
    Aim("start-up", RUN, (START,)),
    Aim("compiling", RUN, (COMPILING,), is_cold=True),
    Aim("parts", RUN, (PARTS,)),
    Aim("merge", RUN, (MERGE,), by_operation=True),
    Aim("finish", RUN, (FINISH,), by_operation=True),
    Aim("export", "export hybrid --to cpp --out {out}", (START,), by_operation=True),
    Aim("map", MAP, (PARTS, COMPILING, MERGE, FINISH)),
)
BY_PROCESSES = Aim(f"parts by {LOCAL}", f"{RUN} --scheduler {LOCAL}", (PARTS,))
"""Beside the phases: a tenth as many kills of a run by two processes of Dask."""
PAGE = "60-provenance.md"
INDEX = "# A book of one page\n\nIt cites {cite}`murphy1988`.\n"
CONTENTS = "format: jb-book\nroot: index\nchapters:\n- glob: pages/*\n"


def make_book(tree: Path, run_folder: Path) -> Aim:
    """Copy the report's program and one of its pages, with a run for it to show; return the aim of building it."""
    left_out = shutil.ignore_patterns("__pycache__", "_build", "pages", "index.md", "law_pages.py")
    for room in ("bench", "tasks", "report"):
        shutil.copytree(ROOT / room, tree / room, ignore=left_out)
    for name in ("pyproject.toml", "CITATION.cff", f"report/pages/{PAGE}"):
        (tree / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tree / name)
    config = tree / "report" / "_config.yml"
    config.write_text(config.read_text(encoding="utf-8").replace("    law_pages: extensions\n", ""), encoding="utf-8")
    (tree / "report" / "index.md").write_text(INDEX, encoding="utf-8")
    (tree / "report" / "_toc.yml").write_text(CONTENTS, encoding="utf-8")
    shutil.copytree(run_folder, tree / "results" / "latest")
    html = tree / "report" / "_build" / "html"
    return Aim("report", "", ("report",), program=tree / "report" / "build.py", folder=html)


def main() -> None:
    """Run the study; the file is written after every kill."""
    phases = [*(one.phase for one in AIMS), "report"]
    parser = make_parser("survival", __doc__, out=ROOT / "results" / "survival" / "survival.json", workers=3)
    parser.add_argument("--kills", type=int, default=100, help="how many, over all phases (default: 100)")
    options = parser.parse_args()
    about, began = describe() | {"command": "python -P -m bench.studies.survival"}, time.monotonic()
    about["versions"]["distributed"] = version("distributed")
    found: dict = {"provenance": about, "kills": []}
    writing = threading.Lock()

    def report(row: dict) -> None:
        with writing:
            found["kills"].append(row)
            about["wall_s"] = round(time.monotonic() - began)
            files.write_json(options.out, found)
            print(f"{len(found['kills'])}: {row}", flush=True)

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as here:
        folder, cache = Path(here), Path(here) / "cache"
        known = {RUN: leave_alone(AIMS[0], folder, cache)}
        least, more = divmod(options.kills, len(phases))
        kills = {one: least + (at < more) for at, one in enumerate(phases)} | {BY_PROCESSES.phase: options.kills // 10}

        def study(aim: Aim) -> None:
            wanted = known.get(aim.words) or leave_alone(aim, folder, cache)
            kill_evenly(aim, kills[aim.phase], wanted, folder, cache, report)

        book = make_book(folder / "tree", folder / f"{AIMS[0].phase}-cold")
        with ThreadPoolExecutor(options.workers) as pool:
            list(pool.map(study, (book, *AIMS, BY_PROCESSES)))


if __name__ == "__main__":
    main()

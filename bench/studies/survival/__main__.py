"""Kill commands in each of their phases, give them again, and compare what they end with: results/survival.

python -m bench.studies.survival                             a hundred kills: half an hour
python -m bench.studies.survival --kills 16 --out try.json
"""

import multiprocessing
import random
import shutil
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path
from typing import Any

from bench.base import files
from bench.base.provenance import ROOT, describe
from bench.running import run
from bench.studies.study import make_parser
from bench.studies.survival.aimed import Aim, kill_evenly, leave_alone
from bench.studies.survival.killed import SEED, SHORT, files_of, how_far, undisturbed
from bench.studies.survival.traced import COMPILING, FINISH, MERGE, PARTS, START

LOCAL = "local:2"
RUN = (
    *(
        "run",
        "--suite",
        "quick",
        "--regulator",
        "rotation-matrix",
        "--engine",
        "ideal-rk4",
        "--experiment",
        "free-body",
    ),
    *("--count", "4", "--workers", "1", "--out", "{out}"),
)
"""One law on the free body: eight units."""
MAP = ("map", "--regulator", "rotation-matrix", "--starts", "10000", "--workers", "1", "--out", "{out}")
AIMS = (
    Aim("start-up", RUN, (START,)),
    Aim("compiling", RUN, (COMPILING,), is_cold=True),
    Aim("parts", RUN, (PARTS,)),
    Aim("merge", RUN, (MERGE,), by_operation=True),
    Aim("finish", RUN, (FINISH,), by_operation=True),
    Aim("export", ("export", "hybrid", "--to", "cpp", "--out", "{out}"), (START,), by_operation=True),
    Aim("map", MAP, (PARTS, COMPILING, MERGE, FINISH)),
)
BY_PROCESSES, WORKER = Aim(f"parts by {LOCAL}", (*RUN, "--scheduler", LOCAL), (PARTS,)), "a worker of two"
"""Beside the phases: a run by two processes of Dask that is killed, and one of which a worker is."""
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
    return Aim("report", (), ("report",), program=tree / "report" / "build.py", folder=html)


def kill_workers(kills: int, folder: Path, report: Callable[[dict], None]) -> None:
    """Kill one of two workers when a random unit but the last is done; the run goes on with the other."""
    chance, wanted = random.Random(SEED), undisturbed(SHORT, folder / "short")
    for k in range(kills):
        out, todo = folder / f"worker-{k}", list(wanted.plan.units)
        at: list[dict] = []
        last = chance.randrange(1, len(todo))

        def kill_a_worker(_: Any, out: Path = out, todo: list = todo, at: list = at, last: int = last) -> None:
            todo.pop()
            if len(todo) == last:
                at.append(how_far(out))
                chance.choice(multiprocessing.active_children()).kill()

        run.run(wanted.plan, out, scheduler=LOCAL, report=kill_a_worker)
        row = {"phase": WORKER, "units_done": at[0]["parts"], "tables_done": 0, "missed": 0, "went_on": True}
        report({**row, "same": files_of(out) == wanted.files})


def main() -> None:
    """Run the study; the file is written after every kill."""
    phases = [*(one.phase for one in AIMS), "report"]
    parser = make_parser("survival", __doc__, out=ROOT / "results" / "survival" / "survival.json", workers=3)
    parser.add_argument("--kills", type=int, default=100, help="how many, over all phases (default: 100)")
    options = parser.parse_args()
    about, began = describe() | {"command": "python -m bench.studies.survival"}, time.monotonic()
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
        kill_workers(options.kills // 10, folder, report)  # first: threads of this process are copied by a fork
        known: dict = {}
        for aim in (*AIMS, BY_PROCESSES):
            known[aim.words] = known.get(aim.words) or leave_alone(aim, folder, cache)
        book = make_book(folder / "tree", folder / f"{AIMS[0].phase}-cold")
        known[book.words] = leave_alone(book, folder, cache)
        with ThreadPoolExecutor(options.workers) as pool:
            each = {
                one: options.kills // len(phases) + (at < options.kills % len(phases)) for at, one in enumerate(phases)
            }
            each[BY_PROCESSES.phase] = options.kills // 10
            started = [
                pool.submit(kill_evenly, aim, each[aim.phase], known[aim.words], folder, cache, report)
                for aim in (book, *AIMS, BY_PROCESSES)
            ]
            for one in started:
                one.result()


if __name__ == "__main__":
    main()

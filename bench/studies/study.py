"""What every study has: a command line, and parts that are kept as soon as they are made, so that a call can go on."""

import argparse
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from bench.base.errors import BadNumber
from bench.base.files import read_json, write_json
from bench.base.on_first_use import pd
from bench.base.provenance import describe, source_digest
from bench.experiments.request import MOST_WORKERS, check_workers
from bench.experiments.tables.store import write_table


def make_parser(
    name: str, doc: str | None, parts: Iterable[str] = (), out: Path | None = None, workers: int = 0
) -> argparse.ArgumentParser:
    """Return the parser of `python -P -m bench.studies.NAME`: --only where there are parts, --out, --workers."""
    parser = argparse.ArgumentParser(prog=f"python -P -m bench.studies.{name}", description=(doc or "").split("\n")[0])
    if parts:
        parser.add_argument("--only", nargs="+", choices=list(parts), metavar="PART", help=f"of {', '.join(parts)}")
    if out:
        shown = f"where to write (default: results/{out.parent.name})"
        parser.add_argument("--out", type=Path, default=out, help=shown)
    if workers:
        parser.add_argument("--workers", type=count_workers, default=workers, help=f"threads (default: {workers})")
    return parser


def count_workers(word: str) -> int:
    """Return the number of threads that a word says; argparse refuses one that cannot work, in one line."""
    try:
        number = int(word)
        check_workers(number)
    except (ValueError, BadNumber) as error:
        cure = f"'{word}' is no number of threads: give a whole number from 1 to {MOST_WORKERS} (try: 2)"
        raise argparse.ArgumentTypeError(cure) from error
    return number


def describe_study(name: str, **more: Any) -> dict[str, Any]:
    """Return the provenance of a study's results; the command is the study's, whatever its words."""
    return describe() | {"command": f"python -P -m bench.studies.{name}"} | more


def make_parts(out: Path, parts: Mapping[str, Callable[[], Any]]) -> dict[str, Any]:
    """Make parts by name, each written beside `out`, so that a stopped call goes on if the sources are the same."""
    beside, digest = out.with_name(f"{out.stem}-unfinished.json"), source_digest()
    kept = read_json(beside) if beside.is_file() else {}
    made: dict[str, Any] = kept["parts"] if kept.get("sources") == digest else {}
    for name in parts:
        if name not in made:
            began = time.process_time()
            made[name] = parts[name]()
            write_json(beside, {"sources": digest, "parts": made})
            print(f"{name}: {time.process_time() - began:.0f} s of CPU", flush=True)
    beside.unlink(missing_ok=True)
    # In the order of `parts`: what was kept comes back sorted by name, and a stopped study is to give the same bytes.
    return {name: made[name] for name in parts}


def keep_table(name: str, out: Path, rows: pd.DataFrame, table: str = "", **about: Any) -> None:
    """Write the table of a study, named as the study unless said otherwise, and beside it where it comes from."""
    write_table(out, rows, table or name)
    write_json(out.with_name("provenance.json"), describe_study(name, **about))
    print(f"wrote {out.parent.name}/{out.name}: {len(rows)} rows")


def make_table(name: str, doc: str | None, out: Path, parts: Mapping[str, Callable[[], list[dict]]]) -> None:
    """Run the command of a study whose parts are rows of the table NAME, and write it with its provenance."""
    out = make_parser(name, doc, out=out).parse_args().out
    keep_table(name, out, pd.DataFrame([row for part in make_parts(out, parts).values() for row in part]))

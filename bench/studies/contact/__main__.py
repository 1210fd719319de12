"""What tasks in contact depend on: results/contact/contact.json."""

import functools
import math
from collections.abc import Callable
from typing import Any

from bench.base.files import read_json, write_json
from bench.base.provenance import ROOT
from bench.studies.contact import pegs, stability
from bench.studies.study import make_parser, make_parts

STORED = ROOT / "results" / "contact" / "contact.json"

PARTS = {
    "boundary": stability.boundaries,
    "fits": pegs.fits,
}


def main() -> None:
    """Run the study."""
    chosen = make_parser("contact", __doc__, PARTS, STORED).parse_args()
    found = read_json(chosen.out) if chosen.out.is_file() else {}
    parts = {name: functools.partial(_written_rows, rows) for name, rows in PARTS.items()}
    write_json(chosen.out, found | make_parts(chosen.out, parts, chosen.only))


def _written_rows(rows: Callable[[], list[dict]]) -> list[dict]:
    return [{key: _written(value) for key, value in row.items()} for row in rows()]


def _written(value: Any) -> Any:
    """Numbers to six figures; one that is not finite as null (no boundary up to the stiffest, nothing to measure)."""
    if not isinstance(value, float):
        return value
    return float(f"{value:.6g}") if math.isfinite(value) else None


if __name__ == "__main__":
    main()

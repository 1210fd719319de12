"""What tasks in contact depend on: results/contact/contact.json.

python -m bench.studies.contact                    all of it, some five minutes
python -m bench.studies.contact --only boundary    run one part again; the others stay as they are
"""

import argparse
import math
from pathlib import Path

from bench.base.files import read_json, write_json
from bench.base.provenance import ROOT
from bench.studies.contact import admittance, pegs, springs, stability, unshaped

STORED = ROOT / "results" / "contact" / "contact.json"

PARTS = {
    "boundary": stability.boundaries,
    "noise": stability.noise,
    "springs": springs.rows,
    "fits": pegs.fits,
    "sensitivity": pegs.sensitivity,
    "admittance": admittance.limits,
    "unshaped": unshaped.rows,
    "unshaped-tasks": unshaped.in_tasks,
}


def main() -> None:
    """The study's command."""
    parser = argparse.ArgumentParser(prog="python -m bench.studies.contact", description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=list(PARTS), help="run one part again")
    parser.add_argument("--out", type=Path, default=STORED, help="where to write (default: results/contact)")
    chosen = parser.parse_args()
    found = read_json(chosen.out) if chosen.out.is_file() else {}
    for name in [chosen.only] if chosen.only else list(PARTS):
        print(name, flush=True)
        found[name] = [{key: _written(value) for key, value in row.items()} for row in PARTS[name]()]
        write_json(chosen.out, found)


def _written(value):
    """Numbers to six figures; one that is not finite as null (no boundary up to the stiffest, nothing to measure)."""
    if not isinstance(value, float):
        return value
    return float(f"{value:.6g}") if math.isfinite(value) else None


if __name__ == "__main__":
    main()

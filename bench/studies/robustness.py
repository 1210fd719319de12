"""How many of hundreds of starts does each law lose at each level of each perturbation? Kept in results/robustness.

A suite's two dozen starts a level tell 24 of 24 from 20 of 24. Of STARTS the exact 95 % interval of a share is 5 points
to either side at the widest.
"""

import shutil

from bench.experiments import plan as planning
from bench.experiments.request import Request
from bench.experiments.tables.store import read
from bench.findings.perturbed import STUDY, by_level
from bench.law.contenders.registry import simulated_contenders
from bench.running import run
from bench.studies.study import keep_table, make_parser

STARTS = 400
"""Evenly spread; the axes with starts of their own take as many. 20 of 40 settle to 15 points, 200 of 400 to 5."""

UNFINISHED = STUDY / "run"
"""The run's folder, until it is finished."""


def main() -> None:
    """Run the study, or go on, and keep a row a law and level."""
    workers = make_parser("robustness", __doc__, workers=2).parse_args().workers
    laws = simulated_contenders()
    request = Request("default", tuple(laws), count=STARTS, experiments=("robustness",))
    plan = planning.make(request)
    run.run(plan, UNFINISHED, workers=workers)
    kept = by_level(read(UNFINISHED, "robustness"))
    keep_table("robustness", STUDY / "perturbed.parquet", kept, "perturbed", starts=STARTS)
    shutil.rmtree(UNFINISHED)


if __name__ == "__main__":
    main()

"""Does a verdict depend on the draw, the step or the gains? Claims on 20 seeds, half the step and results/gains.

The words are stored in results/verdicts. A seed draws other starts and poses; what follows from no draw (operations,
contact, boundaries) is the reference's. At half the step all that steps is run again, contact too. Each run is judged
in this process, by the tables that it made and the reference's for the rest, and written when it is done: another call
goes on where one was stopped. Claims under `stale` in the file have newer criteria than its runs, and wait for the
next whole study, which names none.
"""

import dataclasses
import functools
import tempfile
import time
from pathlib import Path
from typing import Any

from bench.base.files import read_json, write_json
from bench.base.on_first_use import pd
from bench.base.provenance import ROOT, source_digest
from bench.experiments import plan as planning
from bench.experiments.experiment import Unit, known_experiments, rows_of
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.suites import IDEAL_MOTORS
from bench.experiments.tables.run import MAIN_ENGINE, Run
from bench.findings import claims
from bench.findings.claims.adequacy import NOISE
from bench.findings.claims.at_gains import GAINS, HALF_STEP, STORED, turned
from bench.findings.claims.controller_costs import BY_COMMON, BY_EULER, ON_MATRIX
from bench.law.contenders.registry import simulated_contenders
from bench.running import run
from bench.studies.study import describe_study, make_parser, make_parts

REFERENCE = ROOT / "results" / "reference"

SEEDS = tuple(range(1, 21))
STEP_S = 1e-3
RUNS = (*map(str, SEEDS), HALF_STEP)

UNJUDGED = ("linearized-euler-literal",)
"""Laws on the free body of which no claim speaks."""

DRAWN = {
    "free-body": lambda unit: unit.engine == MAIN_ENGINE and unit.law not in UNJUDGED,
    "traces": lambda unit: not unit.arm and unit.law == "feedback-linearized",
    "robustness": lambda unit: unit.selector == NOISE,
    "arm": lambda unit: _is_judged(unit),
    "jacobians": lambda unit: True,
    "probes": lambda unit: True,
}
"""Experiment -> the units of a suite that depend on the seed and that claims look at."""

STEPPED = {name: wanted for name, wanted in DRAWN.items() if name != "jacobians"}
STEPPED |= dict.fromkeys(("boundaries", "contact"), lambda unit: True)
"""The experiments that depend on the step: Jacobians are of poses."""


def _is_judged(unit: Unit) -> bool:
    """Whether C20 looks at the episodes of a unit on an arm."""
    is_there = unit.selector in ("clear", "pole") and unit.variation == IDEAL_MOTORS
    return is_there and unit.contender.partition("+")[0] in (BY_EULER, BY_COMMON, ON_MATRIX)


def plan_of(name: str) -> Plan:
    """Return the part of the reference's suite that is run again."""
    at_half = name == HALF_STEP
    laws = simulated_contenders()
    drawn = {"dt_s": STEP_S / 2} if at_half else {"seed": int(name)}
    suite = read_json(REFERENCE / "plan.json")["suite"]
    whole = planning.make(Request(suite, tuple(laws), **drawn))
    wanted = STEPPED if at_half else DRAWN
    units = (one for one in whole.units if one.experiment in wanted and wanted[one.experiment](one))
    return dataclasses.replace(whole, units=tuple(units))


def judged(name: str, workers: int) -> dict:
    """Return the word of every claim on a run, and what it took."""
    plan, began = plan_of(name), time.process_time()
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder:
        out = Path(folder) / "run"
        run.run(plan, out, workers=workers)
        made = {known_experiments()[unit.experiment].table.name for unit in plan.units}
        reference = Run(REFERENCE)
        shared = {name: reference.table(name) for name in plan.tables if name not in made}
        results = Run(out, shared)
        words = words_of(results)
    return {"words": words, "cpu_s": time.process_time() - began, "sources": source_digest()}


def words_of(results: Run) -> dict[str, str]:
    """Return the word of every claim that the results decide, by its id."""
    return {one.id: str(one.word) for one in claims.judge_possible(results)[0]}


def at_other_gains() -> list[dict]:
    """Return the gains of each run of results/gains, and the words of the claims that its tables decide."""
    units, found = [one for one in plan_of(HALF_STEP).units if one.experiment == "traces"], []
    for path in sorted(GAINS.glob("*/episodes.parquet")):
        gains = Run(path.parent).gains()
        # results/gains has no traces: those that claims look at are made
        traces = pd.concat([rows_of(Request(gains=gains), one) for one in units], ignore_index=True)
        found.append({**gains._asdict(), "words": words_of(Run(path.parent, {"traces": traces}))})
    return found


def main() -> None:
    """Judge the runs that the file lacks, that other sources made, or that are named; exit with 1 if a word changes."""
    words = make_parser("verdicts", __doc__, RUNS, STORED, workers=2).parse_args()
    out, runs = words.out, read_json(words.out)["runs"] if words.out.is_file() else {}
    lacking = words.only or [one for one in RUNS if runs.get(one, {}).get("sources") != source_digest()]
    runs |= make_parts(out, {one: functools.partial(judged, one, words.workers) for one in lacking})
    content: dict[str, Any] = {
        "runs": {one: runs[one] for one in RUNS if one in runs},
        "reference": {one.id: str(one.word) for one in claims.judge_all(REFERENCE)},
        "gains": at_other_gains(),
        "provenance": describe_study("verdicts"),
    }
    write_json(out, content)
    changed = turned(content["runs"], content["reference"])
    for id, others in changed.items():
        print(f"{id}: {others}, on the reference: {content['reference'].get(id)}")
    raise SystemExit(1 if changed else 0)


if __name__ == "__main__":
    main()

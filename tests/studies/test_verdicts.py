"""The committed study of verdicts is of every claim, seed and step, and changes no word; what it runs anew."""

import pytest

from bench.base.files import read_json
from bench.findings import claims
from bench.studies import verdicts
from bench.studies.verdicts import HALF_STEP, RUNS, SEEDS, STORED, plan_of, turned


@pytest.fixture(scope="module")
def stored():
    return read_json(STORED)


def test_stored_study_has_every_seed_and_half_the_step(stored):
    assert len(SEEDS) == 20
    assert set(stored["runs"]) == set(RUNS)


@pytest.mark.slow
def test_no_verdict_hangs_on_the_draw_or_on_the_step(stored):
    reference = {one.id: str(one.word) for one in claims.judge_all(verdicts.REFERENCE)}
    assert list(reference) == [one.id for one in claims.all_claims()]
    assert turned(stored["runs"], reference) == {}


def test_word_that_turns_is_told_by_claim_and_run():
    runs = {"1": {"words": {"C01": "holds", "C02": "does not hold"}}, "2": {"words": {"C01": "holds"}}}
    found = turned(runs, {"C01": "holds", "C02": "holds"})
    assert found == {"C02": {"1": "does not hold", "2": "not judged"}}


def test_seed_and_step_run_what_hangs_on_them():
    drawn, halved = plan_of("3"), plan_of(HALF_STEP)
    assert (drawn.settings.seed, drawn.settings.dt_s) == (3, 1e-3)
    assert (halved.settings.seed, halved.settings.dt_s) == (0, 5e-4)
    kinds, stepped = ({unit.experiment for unit in plan.units} for plan in (drawn, halved))
    assert {"free-body", "arm", "jacobians", "traces", "robustness"} == kinds
    assert stepped == kinds - {"jacobians"} | {"boundaries", "contact"}

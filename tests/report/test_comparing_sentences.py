"""Sentences of leads that compare: each says something else of a planted table."""

import numpy as np
import pandas as pd
import pytest

from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings.perturbed import Direction, Threshold
from bench.findings.selection.regions import RuleVerdict
from bench.findings.selection.run_rows import compare_run
from bench.findings.selection.words import describe_lacks, standing
from report.figures.arms import arms
from report.figures.contact import as_arms_run, in_contact
from report.figures.cost import cost
from report.figures.failures import failure_map
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.libraries import libraries
from report.figures.robustness import half_turn_noise, robustness

FOLDER = RESULTS / "reference"
OURS = "late-braking"


class Planted(Run):
    """The reference with some columns of its tables changed."""

    def __init__(self, **columns):
        super().__init__(FOLDER)
        self.columns = columns

    def any_rows(self, table, **words):
        """Return its rows, with the columns that they have changed."""
        found = super().any_rows(table, **words)
        return found.assign(**{name: value for name, value in self.columns.items() if name in found})


def plant_pegs(bad):
    """State how 24 pegs in leaning frames go in by each controller, so many of the Euler ones not."""
    lines = [(who, 45.0, float(i < (bad if who == "e" else 0))) for who in "ce" for i in range(24)]
    frame = pd.DataFrame([*lines, ("c", 0.0, 0.0), ("e", 0.0, 0.0)], columns=["contender", "beta_deg", "jam"])
    return in_contact.compare_pegs(frame.assign(task="peg-in-hole"), "c", "e")


def plant_arm(excess):
    """State how many of the episodes that do not settle had a joint at its end; one of two does not settle."""
    law = {"controller": "rotation-matrix@geometric", "start_set": "uniform", "outcome": ["settled", "creeping"]}
    rows = pd.DataFrame(law).assign(start_id=[1, 2], arm="panda", kp=100.0, peak_torque_ratio=1.0)
    return arms.lead(rows.assign(range_excess_rad=excess))


def plant_thresholds(*held):
    """List the perturbations along which thresholds of laws differ."""
    each = {
        law: {Direction("delay"): Threshold(one, np.nan, np.nan)}
        for law, one in zip("ab", held, strict=True)
    }
    return [way.axis for way in robustness.differing(each)]


def plant_decision(tied, eligible):
    """State whether the advised law is alone."""
    return standing(RuleVerdict("a", tied, eligible=eligible), str)


def plant_loops(**columns):
    """Count the closed loops that stay at 180° and those that turn away first."""
    found = libraries.responses().assign(**columns)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "responses", lambda: found)
        said = libraries.loop_facts()
    return f"{said['loops_dead']} dead, {said['loops_away']} away"


def plant_lacks(**numbers):
    """State what our law lacks of the requirements, with some of its numbers changed."""
    compared = compare_run(FOLDER)
    rows = compared.rows.copy()
    for name, value in numbers.items():
        rows.loc[rows["contender"] == OURS, name] = value
    return describe_lacks(compared._replace(rows=rows), OURS)


def plant_order(*times):
    """State which of the paper's three laws takes least time alone."""
    return cost.order_papers_laws(dict(zip((MATRIX, LINEARIZED, FEEDBACK), times, strict=True)))


def plant_fact(facts, key):
    """Return a function of columns that states one fact of the reference so changed."""
    return lambda **columns: facts(Planted(**columns))[key]


SENTENCES = {
    "pegs": (plant_pegs, [((3,), "do not differ significantly"), ((18,), "inserted differ significantly")]),
    "arms": (plant_arm, [((0.1,), "range in 100 % of"), ((0.0,), "range in 0 % of")]),
    "thresholds": (plant_thresholds, [((1.0, 1.0), "[]"), ((1.0, 2.0), "['delay']")]),
    "alone": (
        plant_decision,
        [
            (((), 1), "No other law of this run"),
            (((), 2), "more than 5 % slower than one of these laws"),
            ((("b",), 2), "The law ties with b and is the simplest"),
        ],
    ),
    "order": (
        plant_order,
        [((1, 2, 3), "most expensive, as the paper"), ((3, 2, 1), "expensive, other than the paper")],
    ),
    "others": (failure_map.say_others, [((0, 0, 9), "settle from every"), ((2, 0, 9), "from 2 and the feedback")]),
    "loops": (plant_loops, [({}, "3 dead, 4 away"), ({"dead": 0, "away": 1}, "0 dead, 55 away")]),
    "stable": (plant_fact(as_arms_run.facts, "felt_most"), [({}, "7.1"), ({"ratio": 3.0}, "3")]),
    "noise": (plant_fact(half_turn_noise.facts, "blind_middle"), [({}, "25"), ({"outcome": "settled"}, "100")]),
    "least": (plant_fact(failure_map.facts, "least"), [({}, "135"), ({"alpha0": 2.0}, "114")]),
    "ours": (
        plant_lacks,
        [
            ({}, "meets our requirements here"),
            ({"lost": 2.0}, "does not settle from 2 uniform starts"),
            ({"overshoot": 30.0}, "overshoots by 30°, over 5° more"),
        ],
    ),
}


@pytest.mark.parametrize("name", SENTENCES)
def test_sentence_changes_with_its_table(name):
    plant, cases = SENTENCES[name]
    for planted, words in cases:
        said = str(plant(**planted) if isinstance(planted, dict) else plant(*planted))
        assert words in said
        assert not [other for _, other in cases if other in said and other not in words]

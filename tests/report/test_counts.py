"""The table of laws and starts says what other pages say, and what the tables hold."""

import functools
import re

from support.pages import RUN
from support.tables import table

from report.figures.answer import topology
from report.figures.comparison import comparison
from report.figures.kit.page import REPORT
from report.figures.method import counts
from report.figures.robustness import half_turn_noise, robustness


@functools.cache
def list_rows():
    return {count.name: count for count in counts.list_counts(RUN)}


def find_row(words):
    return list_rows()[words]


def test_counts_are_those_of_the_pages():
    compared, perturbed = comparison.facts(RUN), robustness.facts(RUN)
    assert find_row("laws tested for settling").laws == topology.facts(RUN)["laws"]
    assert find_row("laws compared").laws == compared["laws"]
    assert find_row("laws compared").starts == f"{compared['starts']:,}"
    assert find_row("laws under perturbations").laws == perturbed["laws"]
    assert find_row("laws under perturbations").starts == f"{perturbed['starts']:,} at each level"
    assert find_row("laws under noise at 180°").starts == f"{half_turn_noise.facts(RUN)['n']} at each level"


def test_starts_that_the_rotation_matrix_loses_are_those_of_the_rows():
    rows = table("episodes").query("engine == 'ideal-rk4' and task == 'free-body' and law == 'rotation-matrix'")
    rows = rows[(rows["arm"] == "") & rows["start_set"].isin(("uniform", "half-turn", "poles", "wraps", "box"))]
    lost = (rows["outcome"] != "settled").sum()
    assert find_row("the three regulators").lost == f"{lost} of the {len(rows):,} starts"
    assert lost > 0


def test_sets_are_described_by_their_difference():
    basis = counts.list_compared(RUN)
    assert counts.describe_set(basis, RUN) == "the laws of the row “laws compared”"
    fewer = counts.describe_set(basis - {"rotation-matrix"}, RUN)
    assert re.fullmatch("the laws of the row “laws compared” without rotation matrix", fewer, re.IGNORECASE)


def test_pages_that_count_laws_refer_to_the_table():
    for name in ("06-what-an-error-must-do", "appendix-side-by-side", "08-delay-noise-limits"):
        assert "(#laws-and-starts)" in (REPORT / f"pages/{name}.md").read_text(encoding="utf-8")

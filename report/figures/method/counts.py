"""One table of how many laws and starts there are, and where: other pages refer to it and do not count again."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import pandas as pd

from bench.experiments.tables.run import Run, converged
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import count_of
from bench.findings.maps import at_gains, count_in
from bench.findings.selection.regions import read_map
from bench.findings.selection.run_rows import compare_run
from bench.findings.selection.sensitivity import tune
from bench.findings.selection.words import together
from bench.findings.theory.thresholds import HALF_TURN
from bench.law.contenders.registry import contenders
from bench.law.inputs import PAPERS_GAINS
from report.figures.comparison import comparison
from report.figures.failures import failure_map
from report.figures.kit import families, html
from report.figures.kit.laws import MATRIX, TITLES
from report.figures.kit.page import in_run
from report.figures.robustness import robustness
from tasks.situation import NOMINAL

IN_ENGINE = "in-engine"
"""MuJoCo's actuator: the law of the rotation vector, which is not counted twice."""

CONTINUOUS, HELD = "continuous", "sampled"
COUNTS = html.PageTable(
    "Name | Where | Number of laws | Which laws | Starts per law | Continuous or sampled control "
    "| Starts that the rotation-matrix law loses"
)


class Count(NamedTuple):
    """A row: its name, by which pages quote it, a place of the book, laws, starts, and what the rotation matrix loses.

    Attributes:
        lost: How many of the starts the rotation-matrix law does not settle from.
    """

    name: str
    where: str
    laws: int
    which_laws: str
    starts: str
    time: str = html.MISSING
    lost: str = html.MISSING


def facts(run: Run) -> dict[str, Any]:
    """Return the table, and how many sets of laws and starts it has."""
    rows = in_run(lambda: list(list_counts(run)))
    return {"table": COUNTS(rows), "sets": len(rows)} if rows else {}


def list_counts(run: Run) -> Iterator[Count]:
    """Return a row for each place that counts laws or starts, in the order of the book."""
    yield Count(
        name="laws of the catalogue",
        where="[Catalogue](appendix-laws.md)",
        laws=len(contenders("regulators")),
        which_laws="all laws of this repository, also the laws that are wrong on purpose",
        starts=html.MISSING,
    )
    yield count_map(run)
    yield count_at_equal_peak()
    yield from count_settling(run)
    yield count_noise(run)
    yield count_three_laws(run)
    yield count_random(run)
    yield count_perturbed(run)


def describe_lost(lost: int, starts: int) -> str:
    """Say how many of the starts are lost; none is a word."""
    return count_of(lost, starts, "starts")


def list_compared(run: Run) -> set[str]:
    """Return the laws compared: those from evenly spread starts, by which the other rows are described."""
    return set(comparison.uniform(run)["contender"].astype(str)) - set(families.CONTROLS)


def describe_set(laws: set[str], run: Run) -> str:
    """Describe laws by what they lack and add to the laws compared."""
    basis = list_compared(run)
    lacking, added = families.in_order(basis - laws), families.in_order(laws - basis)
    words = "the laws of the row “laws compared”"
    if lacking:
        words += f" without {together([families.word(law) for law in lacking])}"
    if added:
        words += f", with {together([families.word(law) for law in added])}"
    return words


def lose(rows: pd.DataFrame) -> str:
    """Say how many of the rotation matrix's episodes do not settle."""
    matrix = rows[rows["contender"] == MATRIX]
    return describe_lost(int((matrix["outcome"] != "settled").sum()), len(matrix))


def count_map(run: Run) -> Count:
    """Count the laws of the map, with what is lost in the nominal situation."""
    rows = read_map()
    nominal = rows[(rows["contender"] == MATRIX) & (rows["situation"] == NOMINAL.word)].iloc[0]
    return Count(
        name="laws of the map",
        where="[Chapter 7](07-which-error.md), map",
        laws=rows["contender"].nunique(),
        which_laws=describe_set(set(rows["contender"].astype(str)), run),
        starts=f"{rows['starts'].min():,} to {rows['starts'].max():,} in each situation",
        time=HELD,
        lost=f"{describe_lost(int(nominal['lost']), int(nominal['starts']))} in the nominal situation",
    )


def count_at_equal_peak() -> Count:
    """Count the laws of the map that are compared at their best damping ratio."""
    return Count(
        name="laws at equal peak command",
        where="Chapter 7, [equal peak command](#fig-equal-peak); [late braking](appendix-late-braking.md)",
        laws=len(tune()),
        which_laws="the laws of the map with which the body settles from every start in the nominal situation",
        starts="as for the laws of the map",
        time=HELD,
    )


def count_settling(run: Run) -> Iterator[Count]:
    """Count the laws that settle and those compared, at evenly spread starts and at directed ones."""
    compared = compare_run(run.folder)
    laws = [law for law in compared.laws if law not in (*families.CONTROLS, IN_ENGINE)]
    ideal, uniform = comparison.ideal(run), comparison.uniform(run)
    directed = comparison.directed_starts(ideal)
    sure = converged(directed)
    a_law = directed.groupby("contender", observed=True).size()
    yield Count(
        name="laws tested for settling",
        where="[Chapter 6](06-what-an-error-must-do.md)",
        laws=len(laws),
        which_laws=describe_set(set(laws), run),
        starts=f"{uniform['start_id'].nunique():,} evenly spread and {a_law.min():,} to {a_law.max():,} directed",
        time=CONTINUOUS,
    )
    yield Count(
        name="laws compared",
        where="[Comparison of all laws](appendix-side-by-side.md), evenly spread starts",
        laws=len(list_compared(run)),
        which_laws="all laws that we simulated from these evenly spread starts, except those that are wrong on purpose",
        starts=f"{uniform['start_id'].nunique():,}",
        time=CONTINUOUS,
        lost=lose(uniform),
    )
    yield Count(
        name="laws from directed starts",
        where="Comparison of all laws, directed starts",
        laws=directed["contender"].nunique(),
        which_laws=describe_set(set(directed["contender"].astype(str)), run),
        starts=f"{a_law.min():,} to {a_law.max():,}",
        time=CONTINUOUS,
        lost=lose(sure),
    )


def count_noise(run: Run) -> Count:
    """Count the laws that are tested with noise at 180°."""
    rows = robustness.along(run, HALF_TURN)
    laws = set(robustness.laws(rows, controls=False))
    return Count(
        name="laws under noise at 180°",
        where="Chapter 6, [noise at 180°](#noise-at-the-half-turn)",
        laws=len(laws),
        which_laws=describe_set(laws, run),
        starts=f"{robustness.starts(rows):,} at each level",
        time=HELD,
    )


def count_three_laws(run: Run) -> Count:
    """Count the starts of the figure of the paper's three laws."""
    rows = run.rows("episodes", engine="ideal-rk4")
    rows = rows[rows["start_set"].isin(failure_map.SETS) & rows["contender"].isin(TITLES)]
    a_law = rows.groupby("contender", observed=True).size()
    a_law = a_law[a_law > 0]
    span = f"{a_law.min():,}" if a_law.min() == a_law.max() else f"{a_law.min():,} to {a_law.max():,}"
    return Count(
        name="the three regulators",
        where="[Chapter 2](02-three-regulators.md), [figure](#fig-three-laws)",
        laws=len(a_law),
        which_laws="the regulators of Murphy",
        starts=f"{span}, evenly spread and directed",
        time=CONTINUOUS,
        lost=lose(rows),
    )


def count_random(run: Run) -> Count:
    """Count the laws and the random starts of the maps of failures."""
    rows = at_gains(count_in(RESULTS / "maps"), PAPERS_GAINS)
    at_rest = rows[rows["most_speed"] == 0.0]
    matrix = at_rest[at_rest["contender"] == MATRIX]
    return Count(
        name="laws simulated from random starts",
        where="Chapter 2, random starts",
        laws=at_rest["contender"].nunique(),
        which_laws=describe_set(set(at_rest["contender"].astype(str)), run),
        starts=f"{int(at_rest['starts'].min()):,}",
        time=CONTINUOUS,
        lost=describe_lost(int(matrix["lost"].sum()), int(matrix["starts"].sum())),
    )


def count_perturbed(run: Run) -> Count:
    """Count the laws and starts of the perturbations."""
    laws = set(robustness.found(run)) - set(families.CONTROLS)
    return Count(
        name="laws under perturbations",
        where="[Chapter 8](08-delay-noise-limits.md)",
        laws=len(laws),
        which_laws=describe_set(laws, run),
        starts=f"{int(robustness.counted(run, 'delay')['starts'].max()):,} at each level",
        time=HELD,
    )

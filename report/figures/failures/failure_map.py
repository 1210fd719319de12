"""What the page on failures shows: which starts each of the paper's laws loses, in numbers and against the angle."""

import math

import numpy as np

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.claims.tables import settled
from bench.findings.maps import counted, lost_share
from report.figures.failures import hero
from report.figures.kit import html
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX
from report.figures.kit.page import Run, in_run


def facts(run: Run) -> dict:
    """Return how much each law loses, the paper's three laws from every angle, and where the failures begin."""
    mapped = counted(read.table(RESULTS / "maps", "map"))  # the maps that came with the benchmark
    own = mapped[(mapped["contender"] == LINEARIZED) & (mapped["most_speed"] == 0.0)]  # at rest
    value, low, high = (100.0 * one for one in lost_share(int(own["lost"].sum()), int(own["starts"].sum())))
    return {
        "mapped": html.number(int(mapped["starts"].min())),
        "mapped_l": f"{value:.2f} % ({low:.2f} to {high:.2f})",
        # |Edot| over |omega| half a degree off a pole
        "gain": f"{1.0 / math.sqrt(1.0 - math.cos(math.radians(0.5))):.0f}",
        "hero": in_run(lambda: hero.hero(run.rows("episodes", engine="ideal-rk4"))),
        **(in_run(lambda: on_the_map(run)) or {}),
    }


def on_the_map(run: Run) -> dict:
    """Return what the uniform starts of the run say, on the continuous plant, whose end no shorter step moves."""
    rows = read.converged(run.rows("episodes", task="free-body", engine="ideal-rk4", start_set="uniform"))
    linearized, *others = (rows[rows["contender"] == name] for name in (LINEARIZED, MATRIX, FEEDBACK))
    failed, *lost = (own[~settled(own)] for own in (linearized, *others))
    return {
        "n": len(linearized),
        "failed_l": len(failed),
        "failed_others": " and ".join(str(len(own)) for own in lost) if any(map(len, lost)) else "none",
        "least": f"{np.floor(np.degrees(failed['alpha0'].abs().min())):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
    }

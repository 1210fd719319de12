"""Robustness: which perturbations each law withstands, and at what share of starts it ends under the others."""

import math

import pandas as pd

import tasks
from bench.cli.details.episodes import OF_STARTS, settled
from bench.findings.perturbed import FOLLOWED_RAD, perturbations, went_well
from bench.tables import read as results

WITHSTOOD = 95
"""Share of its starts [%] that go well at every level of a perturbation that a law withstands."""


IS_WITHSTOOD = (
    f"at least {WITHSTOOD} % settle at every level; where it lasts, end within {math.degrees(FOLLOWED_RAD):g} deg rms"
)


FEW = 3
"""Perturbations up to which each has a table of its own."""


def tables(rows):
    """One table; of few perturbations one more for each."""
    least = least_shares(rows)
    nobody = [axis for axis in least if not (least[axis] >= WITHSTOOD).any()]
    title = f"robustness ({OF_STARTS}; withstood: {IS_WITHSTOOD})"
    table = summary(rows)
    if nobody and len(nobody) < least.shape[1]:
        title += f"\nwithstood by no law, and left out on the right: {', '.join(nobody)}"
    yield title, table
    for axis in least if least.shape[1] <= FEW else ():
        own = results.with_contender(rows[rows["axis"] == axis]).astype({"contender": str})
        levels = (
            own.groupby(["contender", "level"], sort=False)[["outcome"]].apply(settled).unstack().sort_index(axis=1)
        )
        shown = levels.rename(columns="{:g}".format).rename_axis("law").reset_index()
        yield f"{axis} [{tasks.axis(axis).unit}], level by level ({OF_STARTS})", shown


def summary(rows):
    """One line for each law: perturbations withstood, and its least share [%] under others that some law withstands."""
    least = least_shares(rows)
    withstood = least >= WITHSTOOD
    shown = withstood.any() if withstood.to_numpy().any() else withstood.any() | True
    named = results.with_contender(rows)
    lines = []
    for name, one in least.iterrows():
        short = ", ".join(f"{axis} {share:.0f}" for axis, share in one[shown].items() if share < WITHSTOOD)
        lines.append(
            {
                "law": str(name),
                "settled": settled(named[named["contender"] == name]),
                f"withstood of {one.size}": int((one >= WITHSTOOD).sum()),
                "settled least [%]": short,
            }
        )
    return pd.DataFrame(lines)


def least_shares(rows):
    """A row a law, a column a perturbation: the share [%] that went well at its worst level."""
    is_perturbed = rows["axis"].isin(perturbations())
    named = results.with_contender(rows[is_perturbed] if is_perturbed.any() else rows)
    well, by = 100.0 * went_well(named), [named["contender"], named["axis"], named["level"]]
    shares = well.groupby(by, observed=True, sort=False).mean()
    return shares.groupby(level=[0, 1], observed=True, sort=False).min().unstack()

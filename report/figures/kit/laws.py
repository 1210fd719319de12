"""The laws as figures name them: the paper's three in its order, and any law of a run; and the gains of rows."""

import pandas as pd

from bench.experiments.tables.run import shown_run
from bench.law.contender import Contender
from bench.law.contenders.registry import papers_laws
from bench.law.kinds import Law

TITLES = {one.name: one.regulator.title.partition(" (")[0] for one in papers_laws()}
"""contender -> how it is called in a figure."""
MATRIX, LINEARIZED, FEEDBACK = TITLES


def gains(rows: pd.DataFrame) -> tuple[float, float]:
    """(kp, kv) of the rows."""
    return float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0])


def regulator(word: str) -> Law | None:
    """Return the regulator of that name, the user's own of the run among them; None if there is none."""
    return shown_run().find_law(word)


def contender(name: str) -> Contender | None:
    """Return the contender of a name, as rows write it; None if there is none."""
    return shown_run().find_contender(name)


def title(name: str) -> str:
    """Return the title of a law by its name; the name itself of a law that is not known."""
    one = contender(name)
    return title_of(one) if one else name


def title_of(one: Contender) -> str:
    """Return the law's title, and its coordinates where they are others than the paper's."""
    where, title = one.representation, one.regulator.title
    return (
        f"{title} in {where.display.short or where.name}"
        if where and one.uses_nonpaper_coordinates
        else title
    )


def regulator_of(name: str) -> str:
    """Return the regulator's word in a contender's name."""
    return name.partition("@")[0].partition("/")[0]


def is_users(word: str) -> bool:
    """Return whether a regulator came with the run that is shown, not with the benchmark."""
    return shown_run().is_users(word)

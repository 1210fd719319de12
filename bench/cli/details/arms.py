"""Arms: what each controller settles from each start set, what its failures were near, and what wrong models do."""

import pandas as pd

from bench.cli.details.episodes import OF_STARTS, by_contender, places, seconds, settled
from bench.experiments.suites import NOMINAL
from tasks.cause import CAUSES


def tables(episodes):
    """A table for each arm, then one for each whose plant is not the controller's model."""
    is_nominal = episodes["variation"] == NOMINAL
    for place, part in places(episodes[is_nominal]):
        yield f"{place} ({OF_STARTS})", summary(part)
    for place, part in places(episodes[~is_nominal]):
        yield f"{place}, model errors ({OF_STARTS}; then the median final angle [mrad])", variations(part)


def summary(episodes):
    """One line for each controller: settled of each start set, settling times [s], and the causes of its failures."""
    lines = []
    for name, rows in by_contender(episodes):
        line = {"controller": name}
        for start_set, part in rows.groupby("start_set", observed=True, sort=True):
            line[str(start_set)] = settled(part)
        causes = rows["cause"].astype(str).value_counts()
        near = ", ".join(f"{causes[one]} {one}" for one in CAUSES if one and one in causes)
        lines.append({**line, **seconds(rows), "failures near": near})
    return pd.DataFrame(lines)


def variations(episodes):
    """One line for each controller, one column for each variation of the plant: settled, and the median angle left."""
    lines = []
    for name, rows in by_contender(episodes):
        line = {"controller": name}
        for variation, part in rows.groupby("variation", observed=True, sort=False):
            line[str(variation)] = f"{settled(part)}  {1e3 * part['final_angle_rad'].median():.3g}"
        lines.append(line)
    return pd.DataFrame(lines)

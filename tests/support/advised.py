"""The laws that the rule of the map advises for robots, by the rule written a second time, on arrays.

Only whose laws are ours and what a law remembers is read from the program.
"""

import functools

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.regions import RuleVerdict
from bench.law.contenders.registry import find_contender
from support.tables import table

DRAWS = 2000
TIE, OVERSHOOT_DEG, DETOUR, AWAY_RAD = 0.05, 5.0, 1.5, 0.05


def crowd(values):
    """Return the 99 % quantile over the starts of arrays (..., starts, laws), which is one of the values."""
    place = int(np.ceil(0.99 * values.shape[-2] - 1e-9)) - 1
    return np.take(np.partition(values, place, axis=-2), place, axis=-2)


def mean(values):
    """Return the mean over the starts of arrays (..., starts, laws)."""
    return values.mean(axis=-2)


class Asked:
    """Laws on the starts of a robot.

    values: a row a start, a column a law. counts: a row a law, a column for each thing that no start may do.
    overshoot: of each law [deg], where it was measured. number: what is compared of the values.
    """

    def __init__(self, values, counts, number, overshoot=None):
        self.values, self.counts, self.number, self.overshoot = values, counts, number, overshoot

    def qualify(self):
        """Return the laws that meet the requirements, in alphabetic order."""
        number = pd.Series(self.number(self.values.to_numpy(float)), self.values.columns)
        counts = self.counts.reindex(number.index)
        has = (counts == 0).all(axis=1) & np.isfinite(number)
        if self.overshoot is not None:
            published = [law for law in number.index if has[law] and not is_ours(law)]
            has &= ~(self.overshoot[number.index] > self.overshoot[published].min() + OVERSHOOT_DEG)
        return sorted(has.index[has])

    def find_worse(self, laws):
        """Return whether the law of a row is worse than that of a column, by the share of the tie and by resamples."""
        values = self.values[laws].to_numpy(float)
        number = self.number(values)
        which = np.random.default_rng(0).integers(len(values), size=(DRAWS, len(values)))
        drawn = self.number(values[which])
        with np.errstate(invalid="ignore"):
            more = np.nan_to_num(drawn[:, :, None] - drawn[:, None, :], nan=0.0, posinf=np.inf, neginf=-np.inf)
        is_sure = np.quantile(more, 0.025, axis=0, method="inverted_cdf") > 0.0
        is_notable = number[None, :] < (1.0 - TIE) * number[:, None]
        return pd.DataFrame(is_sure & is_notable, laws, laws)

    def decide(self):
        """Return the verdict."""
        laws = self.qualify()
        is_worse = self.find_worse(laws)
        published = [law for law in laws if not is_ours(law)]
        kept = [law for law in laws if not is_worse.loc[law, published].any()]
        unbeaten = [law for law in kept if law in published]
        first, *tied = sorted(unbeaten, key=lambda law: (*simplicity(law), law))
        ours = [law for law in kept if law not in published]
        faster = [law for law in laws if law not in published and is_worse.loc[first, law]]
        return first, tuple(tied), frozenset(ours), frozenset(faster), len(laws)


def unordered(verdict: RuleVerdict):
    """Return a verdict as `Asked.decide` has it: our own laws in no order."""
    return (
        verdict.law,
        verdict.tied,
        frozenset(verdict.ours),
        frozenset(verdict.faster),
        verdict.eligible,
    )


def simplicity(law):
    """Return the numbers kept and the operations of a tick."""
    return len(find_contender(law).regulator.memory or ()), sum(operations(law))


@functools.cache
def is_ours(law):
    """Return whether a law was made here."""
    return find_contender(law).regulator.is_ours()


@functools.cache
def costs():
    """Return law -> operations of a tick, typical branch, with the goal's stage."""
    rows = table("costs").query("jacobian == '' and inverse == '' and branch == 'typical' and stage == 'total'")
    return rows.set_index("law")


def operations(law):
    """Return the flops and calls of a law's tick."""
    return costs().loc[law, "flops"], costs().loc[law, ["sin", "cos", "atan2", "acos"]].sum()


def by_start(rows, column, failed=None):
    """Return a row a start and a column a law; `failed` where a law does not settle."""
    values = rows[column] if failed is None else rows[column].where(rows["outcome"] == "settled", failed)
    keys = [name for name in ("arm", "kp", "start_set", "start_id") if name in rows]
    wide = rows.assign(value=values.astype(float)).pivot(index=keys, columns="law", values="value")
    return wide.dropna(how="all").dropna(axis=1, how="all")


def common(rows):
    """Return the rows of starts that every law ran."""
    ran = rows.groupby(["start_set", "start_id"])["law"].transform("nunique")
    return rows[ran == rows["law"].nunique()]


def shares_of_time():
    """Return law -> its time alone over a whole controller's [%]."""
    [path] = (RESULTS / "timings").glob("*.parquet")
    rows = table(path.stem, "timings").query("ticks > 0")
    whole = rows.query("what == 'controller' and law == 'rotation-matrix' and jacobian == 'geometric'")["ratio"]
    return 100.0 * rows[rows["what"] == "law"].set_index("law")["ratio"] / whole.median()


def standard(rows):
    """Return the rows of arms by the plain inverse, or the pseudo-inverse where a law has no plain one on an arm."""
    rows = rows[rows["inverse"].isin(("solve", "pseudo-inverse"))]
    has_plain = (rows["inverse"] == "solve").groupby([rows["law"], rows["arm"]]).transform("any")
    return rows[(rows["inverse"] == "solve") | ~has_plain]


def count(rows, is_counted):
    """Return law -> how many of its rows are counted."""
    return is_counted.groupby(rows["law"]).sum()


@functools.cache
def arms():
    """Return the laws on arms: turns that need a motor's rating or the end of a joint's range, or do not settle."""
    rows = table("episodes")
    free = rows.query("task == 'free-body' and engine in ('ideal-rk4', 'native') and start_set == 'uniform'")
    on_main = free["law"].isin(free.loc[free["engine"] == "ideal-rk4", "law"])
    uniform = common(free[(free["engine"] == "ideal-rk4") | ~on_main])
    counts = {
        "lost": count(uniform, uniform["outcome"] != "settled"),
        "unwound": count(uniform, uniform["path_ratio"] > DETOUR),
    }
    overshoot = by_start(uniform, "overshoot_rad")
    on_arms = rows.query("task == 'arm-regulation' and start_set == 'uniform' and jacobian == 'geometric'")
    on_arms = standard(on_arms.query("variation == 'nominal' and engine == 'native'"))
    is_free = (on_arms["peak_torque_ratio"] <= 0.99) & (on_arms["range_excess_rad"] <= 0.0)
    on_arms = on_arms.assign(missed=1.0 - (is_free & (on_arms["outcome"] == "settled")))
    missed = by_start(on_arms[on_arms["law"].isin(uniform["law"])], "missed")
    deg = pd.Series(np.degrees(crowd(overshoot.to_numpy())), overshoot.columns)
    return Asked(missed, pd.DataFrame(counts), mean, deg)


def first_order(starts):
    """Return the first-order laws by the times of some starts; detours and 180° are those of the free body."""
    free = table("velocity").query("limiter == 'none' and share == 1.0 and arm == ''")
    uniform, exact = (common(free[free["start_set"] == name]) for name in ("uniform", "half-turn"))
    counts = {
        "lost": count(starts, starts["outcome"] != "settled"),
        "stuck": count(exact, exact["outcome"] != "settled"),
        "unwound": count(uniform, uniform["furthest_rad"] > uniform["angle0_rad"] + AWAY_RAD),
    }
    times = by_start(starts, "settling_time_s", np.inf)
    return Asked(times, pd.DataFrame(counts), crowd)


@functools.cache
def velocities():
    """Return the laws that command velocities."""
    free = table("velocity").query("limiter == 'none' and share == 1.0 and arm == ''")
    return first_order(common(free[free["start_set"] == "uniform"]))


@functools.cache
def positions():
    """Return the laws that command velocities, on servos that lag."""
    late = table("velocity").query("limiter == 'none' and share == 1.0 and arm != '' and lag_s > 0")
    return first_order(standard(late))

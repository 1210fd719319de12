"""The laws that the rules of `bench.findings.selection` advise, by the rules written a second time, on arrays.

Only what robots ask (robots.toml), whose laws are ours and what a law remembers is read from the program.
"""

import functools

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.findings.selection import needs
from bench.findings.start_sets import DIRECTED
from bench.law.contenders.registry import find_contender
from support.tables import table

GENERAL = ("time", "worst", "effort", "peak", "variation", "tick")
LEVELS = {"time": 0.99, "worst": 1.0, "peak": 1.0}
MEANS, MORE_IS_BETTER = ("unsettled", "arms", "within"), ("arms", "within")
DRAWS = 1000


def take(criterion, values):
    """Return the criterion's number of arrays (..., starts, laws): a mean, or a quantile that is one of the values."""
    if criterion in MEANS:
        return values.mean(axis=-2)
    place = int(np.ceil(LEVELS.get(criterion, 0.5) * values.shape[-2] - 1e-9)) - 1
    return np.take(np.partition(values, place, axis=-2), place, axis=-2)


class Asked:
    """Criterion -> a row a start, a column a law."""

    def __init__(self, values):
        self.values, self.compared = values, {}
        self.laws = sorted(values["memory"].columns, key=lambda law: (*self.simplicity(law), law))

    def simplicity(self, law):
        """Return the numbers kept and the operations of a tick."""
        return self.values["memory"][law].iloc[0], sum(operations(law))

    def number(self, criterion):
        """Return law -> number."""
        frame = self.values[criterion]
        return pd.Series(take(criterion, frame.to_numpy(float)), frame.columns)

    def drawn(self, criterion):
        """Return the numbers (DRAWS, laws) of resampled starts, the same for every law."""
        values = self.values[criterion].to_numpy(float)
        which = np.random.default_rng(0).integers(len(values), size=(DRAWS, len(values)))
        return take(criterion, values[which])

    def beats(self, criterion):
        """Return whether the law of a row is better than that of a column."""
        if criterion in self.compared:
            return self.compared[criterion]
        sense = -1.0 if criterion in MORE_IS_BETTER else 1.0
        number = sense * self.number(criterion)
        own, other = number.to_numpy()[:, None], number.to_numpy()[None, :]
        with np.errstate(invalid="ignore"):
            least = 4.0 if criterion == "tick" else 0.01 * np.abs(other)
            is_better = (own < other) & (np.isinf(other) | (other - own > least))
            values = sense * self.values[criterion].to_numpy(float)
            if LEVELS.get(criterion) == 1.0:
                is_better &= (values[:, None, :] > values.max(axis=0)[None, :, None]).sum(axis=0) >= 5
            elif len(values) > 1:
                drawn = sense * self.drawn(criterion)
                less = np.nan_to_num(drawn[:, :, None] - drawn[:, None, :], nan=0.0, posinf=np.inf, neginf=-np.inf)
                is_better &= np.quantile(less, 0.975, axis=0, method="inverted_cdf") < 0.0
        self.compared[criterion] = pd.DataFrame(is_better, number.index, number.index)
        return self.compared[criterion]

    def front(self, laws, criteria):
        """Return the laws that no other is better than by one of the criteria and worse than by none."""
        better = [self.beats(one).reindex(index=laws, columns=laws) for one in criteria if one in self.values]
        wins = np.any([one.eq(True).to_numpy() for one in better], axis=0)
        dominated = (wins & ~wins.T).any(axis=0)
        return [law for law, is_out in zip(laws, dominated, strict=True) if not is_out] or list(laws)

    def has(self, fact):
        """Return law -> whether it has one of the facts of `needs`."""
        number = self.number
        return {
            needs.FACTS["everywhere"]: lambda: (number("unsettled") + number("lost") == 0) & (number("detour") < 1.5),
            needs.FACTS["nearly"]: lambda: number("unsettled") <= 0.1 + 1e-9,
            needs.FACTS["tried"]: lambda: number("variation").notna(),
        }[fact]()

    def decide(self, need):
        """Return the decision in a situation."""
        facts = [self.has(fact).reindex(self.laws, fill_value=False) for fact in need.facts]
        asked = [law for law in self.laws if all(one[law] for one in facts) and not is_ours(law)]
        asked = [law for law in asked if all(law in self.values[by] for by in need.by)]
        best = self.front(asked, need.by) if need.by else asked
        kept = self.front(best, GENERAL)
        law = min(kept, key=lambda law: (*self.simplicity(law), law))
        return needs.Decision(law, tuple(one for one in kept if one != law), tuple(best), tuple(asked))


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


def alone(numbers):
    """Return one row of a number a law."""
    return pd.Series(numbers, dtype=float).to_frame().T


def timed(uniform, directed, peak):
    """Return the criteria that every kind of command has."""
    time = by_start(uniform, "settling_time_s", np.inf)
    laws = time.columns
    ways = pd.concat([uniform, directed[directed["start_set"] == "half-turn"]]).groupby("law")["path_ratio"].max()
    lost = (directed["outcome"] != "settled").groupby(directed["law"]).sum()
    return {
        **dict.fromkeys(("time", "worst", "median"), time),
        "unsettled": 100.0 * np.isinf(time),
        "lost": alone(lost.reindex(laws, fill_value=0)),
        "detour": alone(ways.reindex(laws)),
        "peak": by_start(uniform, peak, np.inf),
        "tick": alone(shares_of_time().reindex(laws)),
        "memory": alone({law: len(find_contender(law).regulator.memory or ()) for law in laws}),
    }


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


@functools.cache
def accelerations(folder="reference"):
    """Return what laws that command accelerations or torques were asked."""
    rows = table("episodes", folder)
    free = rows.query("task == 'free-body' and engine in ('ideal-rk4', 'native')")
    on_main = free["law"].isin(free.loc[free["engine"] == "ideal-rk4", "law"])
    free = free[(free["engine"] == "ideal-rk4") | ~on_main]
    uniform, directed = common(free.query("start_set == 'uniform'")), common(free[free["start_set"].isin(DIRECTED)])
    perturbed = table("robustness", folder)
    at = dict(iter(perturbed.groupby(["axis", "level"])))
    arms = rows.query("task == 'arm-regulation' and start_set == 'uniform' and jacobian == 'geometric'")
    arms = standard(arms.query("variation == 'nominal' and engine == 'native'"))
    settled = arms["outcome"] == "settled"
    within = settled & (arms["peak_torque_ratio"] <= 0.99) & (arms["range_excess_rad"] <= 0.0)
    known = uniform["law"].unique()
    arms = arms.assign(settled=100.0 * settled, within=100.0 * within)[arms["law"].isin(known)]
    return Asked(
        {
            **timed(uniform, directed, "peak_u"),
            "effort": by_start(uniform, "effort", np.inf),
            "arms": by_start(arms, "settled"),
            "within": by_start(arms, "within"),
            "variation": by_start(at["delay", 0.0], "variation", np.inf),
        }
    )


@functools.cache
def velocities():
    """Return what laws that command velocities were asked."""
    rows = table("velocity").query("limiter == 'none' and share == 1.0")
    rows = rows[rows["law"].isin(accelerations().laws)]
    free, arms = rows.query("arm == ''"), standard(rows.query("arm != '' and lag_s == 0 and start_set == 'uniform'"))
    uniform, exact = (common(free[free["start_set"] == name]) for name in ("uniform", "half-turn"))
    arms = arms[arms["law"].isin(uniform["law"])]
    arms = arms.assign(settled=100.0 * (arms["outcome"] == "settled"))
    return Asked({**timed(uniform, exact, "peak_omega"), "arms": by_start(arms, "settled")})

"""MuJoCo's own actuator beside the laws, all of them inside MuJoCo: the same starts, the same judge."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from bench.tables.statistics import quantile_estimate
from report.figures.comparison.comparison_rows import common, costs
from report.figures.comparison.comparison_tables import by_family, figures, large, percent, seconds, with_interval
from report.figures.kit import absent, html
from report.figures.kit.share import share

ACTUATOR = "in-engine"


def rows(episodes: pd.DataFrame) -> pd.DataFrame:
    """Rows of uniform starts that the actuator and every law ran; none where it is not in the run.

    Args:
        episodes: of the free body in MuJoCo.
    """
    return common(episodes) if (episodes["contender"] == ACTUATOR).any() else episodes.iloc[:0]


def table(found: pd.DataFrame) -> html.Markdown:
    """Share that settles; median and slowest settling time; effort and largest command. Rows of `rows`."""
    return absent.table(found, _table)


def _table(found: pd.DataFrame) -> html.Markdown:
    times, efforts = costs(found, "settling_time_s"), costs(found, "effort")

    def line(name: str, own: pd.DataFrame) -> dict:
        settled, slowest = share(int((own["outcome"] == "settled").sum()), len(own)), times[name].max()
        return {
            "Settles [%]": with_interval(*map(percent, (settled.value, settled.low, settled.high))),
            "Median [s]": seconds(quantile_estimate(times[name].to_numpy(), 0.5)),
            "Slowest [s]": f"{slowest:.3f}" if np.isfinite(slowest) else "never",
            "Effort": figures(quantile_estimate(efforts[name].to_numpy(), 0.5)),
            "Peak": large(own["peak_u"].max()),
        }

    return by_family(found, line)


def facts(episodes: pd.DataFrame) -> dict:
    """From how many starts at rest the actuator settles, and how far from the linear response; else dashes.

    Args:
        episodes: of the free body in MuJoCo.
    """
    keys = ("servo_starts", "servo_settled", "half_turns", "half_turns_settled", "linear_s", "off_linear_ms")
    own = episodes[episodes["contender"] == ACTUATOR]
    if own.empty:
        return dict.fromkeys(keys, html.MISSING)
    uniform, half_turns = (own[own["start_set"] == word] for word in ("uniform", "half-turn"))
    linear = closed_form.linear_settling(*own.iloc[0][["kp", "kv", "tolerance"]])
    late = pd.concat((uniform, half_turns))["settling_time_s"] - linear
    values = (
        len(uniform),
        int((uniform["outcome"] == "settled").sum()),
        len(half_turns),
        int((half_turns["outcome"] == "settled").sum()),
        f"{linear:.3f}",
        f"{1000 * late.abs().max():.1f}",
    )
    return dict(zip(keys, values, strict=True))

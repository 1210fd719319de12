"""How tables of free bodies and arms are compared: each function takes base's and head's rows."""

from collections.abc import Callable

import numpy as np
import pandas as pd

from bench.experiments.columns import Table
from bench.regression.rows.difference import MISSING, NEW, Difference, aligned, changed, compared, near
from bench.tables.schema import table_of
from tasks.verdict import OUTCOMES, SETTLED

RELATIVE = 1e-6
"""Rounding grows by less than a millionth in a settled episode: two libraries' sines (1e-16 apart) and some 1e4 ticks
leave 1e-12; step-size effects that a change of code could bring start at 1e-4."""

ABSOLUTE = 1e-9
"""Below this an angle [rad] or a margin is rounding itself."""

MARGIN = 10.0
"""Times the change that 1e-12 rad made of a doubtful episode on an arm: two samples of what rounding makes of it."""

FRICTION_RELATIVE = 1e-3
"""With dry friction an arm's joints stick and creep, by what MuJoCo's solver leaves of each tick at its own tolerance:
1e-4 of the angle that is left differs between two libraries' sines."""

BOUNDARY_ANGLE = 1e-5
"""Bisection ends at 7e-7 rad; near a fractal boundary the last steps may go either way."""

CURVE_KEY = table_of("traces").key[:-1]
ARRIVED = 0.02
"""A curve whose angle ends below the settling band's share of where it began came to the goal."""

POSE_RELATIVE = 1e-5
"""Single precision is 6e-8; condition numbers up to STEADY lose half the digits of the doubles they are made of."""

SINGLE_RELATIVE = 2e-6
"""RELATIVE, and what single precision makes of two numbers that are apart by as much."""

LIMIT_RELATIVE = 1e-3
"""Bisection ends at 4e-6; at the limit itself errors neither grow nor fall, and rounding decides some steps of it."""

STEADY = 1e8
"""Condition number beyond which the last bit of a joint angle decides its value."""


def of_key(table: Table) -> Callable[[pd.DataFrame, pd.DataFrame], list[Difference]]:
    """Rows of the same key: words exactly, numbers to RELATIVE."""

    def rows(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
        old, new, found = aligned(table, old, new)
        return found + compared(table, old, new, near(RELATIVE, ABSOLUTE))

    return rows


def episodes(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Outcomes exactly, on a knife's edge either; numbers of what settled in both, to what rounding makes of them."""
    table = table_of("episodes")
    old, new, found = aligned(table, old, new)
    settled = old["outcome"].astype(str) == OUTCOMES[SETTLED]
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    found += changed(table, "outcome", old, new, ~same & ~_share_an_outcome(old, new))
    rubs = old["variation"].astype(str).str.startswith("friction").to_numpy()
    known = np.where(rubs, FRICTION_RELATIVE, RELATIVE)
    doubt = MARGIN * np.fmax(old["rounding_change"].to_numpy(), new["rounding_change"].to_numpy())
    loose = np.fmax(known, doubt)  # no doubt is NaN, which fmax passes over
    relative = np.fmin(loose, 1.0)

    def close(name, a, b):
        if name in ("settling_time_s", "failure_time_s"):
            is_close = np.abs(a - b) < 0.5 * old["dt_s"].to_numpy() + (relative - RELATIVE) * b
        elif name == "ticks":
            is_close = np.abs(a - b) <= (relative - RELATIVE) * b
        else:
            is_close = np.isclose(a, b, rtol=relative, atol=ABSOLUTE)
        return is_close | (np.isnan(a) & np.isnan(b))

    judged = ("outcome", "cause", "outcome_beside", "rounding_change")
    return found + compared(table, old, new, close, settled & same & (loose < 1.0), judged)


def velocity(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """As `episodes`; a change of ABSOLUTE by 1e-12 rad is taken for rounding's, and of larger ones MARGIN times it."""
    table = table_of("velocity")
    old, new, found = aligned(table, old, new)
    settled = old["outcome"].astype(str) == OUTCOMES[SETTLED]
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    found += changed(table, "outcome", old, new, ~same & ~_share_an_outcome(old, new))
    doubt = np.fmax(old["rounding_change"].to_numpy(), new["rounding_change"].to_numpy())
    loose = np.fmax(SINGLE_RELATIVE, MARGIN * doubt)

    def close(name, a, b):
        ticks = old["dt_s"].to_numpy() if name in ("settling_time_s", "failure_time_s") else 0.0
        return np.isclose(a, b, rtol=np.fmin(loose, 1.0), atol=ABSOLUTE + 0.5 * ticks, equal_nan=True)

    judged = ("outcome", "outcome_beside", "rounding_change")
    return found + compared(table, old, new, close, settled & same & (loose < 1.0), judged)


def velocity_limits(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """What was bisected, to LIMIT_RELATIVE."""
    table = table_of("velocity-limits")
    old, new, found = aligned(table, old, new)
    return found + compared(table, old, new, near(LIMIT_RELATIVE, LIMIT_RELATIVE))


def _share_an_outcome(old: pd.DataFrame, new: pd.DataFrame) -> np.ndarray:
    """Whether an outcome of base, on either side of a row's start, is one of head's; on no edge there is but one."""
    sides = ("outcome", "outcome_beside")
    pairs = [(old[a].astype(str).to_numpy(), new[b].astype(str).to_numpy()) for a in sides for b in sides]
    return np.any([(was == now) & (was != "") for was, now in pairs], axis=0)


def costs(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Operations, exactly."""
    old, new = (frame.assign(joints=_joints(frame)) for frame in (old, new))
    old, new, found = aligned(table_of("costs"), old, new)
    return found + compared(table_of("costs"), old, new, near(0.0, 0.0))


def _joints(costs: pd.DataFrame) -> pd.Series:
    """Joints as a row's name says them: nothing of a law alone."""
    return costs["joints"].map(lambda joints: f"{joints} joints" if joints else "")


def boundaries(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Where each law first fails, to BOUNDARY_ANGLE."""
    old, new, found = aligned(table_of("boundaries"), old.round(_digits(old)), new.round(_digits(new)))
    return found + compared(table_of("boundaries"), old, new, near(0.0, BOUNDARY_ANGLE), but=["outcome"])


def _digits(frame: pd.DataFrame) -> dict[str, int]:
    """Axes are compared by their first nine digits: they name a row."""
    return {name: 9 for name in frame.columns if name.startswith("axis_")}


def command_field(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Every finding's word, and its numbers where they are bounded; not the state that shows it, one of many alike."""
    table = table_of("command-field")
    old, new, found = aligned(table, old, new)
    kept, is_bounded = [*table.key, "what", "value", "least", "most"], (old["what"] != "unbounded").to_numpy()
    return found + compared(table, old[kept], new[kept], near(POSE_RELATIVE, ABSOLUTE), is_bounded)


def traces(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Samples of the curves that end at the goal; which curves there are, of all."""
    curves = [frame.groupby(list(CURVE_KEY), observed=True)["angle_rad"] for frame in (old, new)]
    was, now = ({tuple(map(str, key)) for key in one.groups} for one in curves)
    found = _curves(MISSING, "curve is missing", was - now) + _curves(NEW, "curve is new", now - was)
    if found:
        return found
    arrived = [one.transform("last") <= ARRIVED * one.transform("first") for one in curves]
    old, new, found = aligned(table_of("traces"), old[arrived[0]], new[arrived[1]])
    # a curve that arrives has settled
    return found + compared(table_of("traces"), old, new, near(RELATIVE, RELATIVE), but=["outcome"])


def _curves(kind: str, words: str, keys: set[tuple[str, ...]]) -> list[Difference]:
    named = [(" ".join(filter(None, key)), dict(zip(CURVE_KEY, key, strict=True))) for key in sorted(keys)]
    return [Difference("traces", kind, "", f"traces: {words}: {name}", row) for name, row in named]


def poses(old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Poses and what their Jacobians are; the gaps are rounding itself, and claims look at their size."""
    old, new, found = aligned(table_of("poses"), old, new)
    steady = (old["condition_analytic"].to_numpy() < STEADY) & (old["condition"].to_numpy() < STEADY)
    gaps = [name for name in old.columns if name.endswith("_gap")]
    return found + compared(table_of("poses"), old, new, near(POSE_RELATIVE, ABSOLUTE), steady, gaps)

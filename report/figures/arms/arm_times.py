"""Time a tick of closed loops on arms: our engine's, over MuJoCo's open loop on the same model, and dm_control's."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_looks, arm_rows
from report.figures.cost import times
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

NONE_YET = "No closed loop on an arm has been timed yet: `make time` does."
COLUMNS = ("arm", "jacobian", "inverse", "ratio_rollout")
TIMES = Table(
    "Arm | Rollout [µs]:.2f | Ours [µs] | Over rollout | dm_control [µs]:.0f | Times as long:.0f | Two threads:.2f"
)


def rows(run: Run) -> pd.DataFrame:
    """Rows about arms of the first machine's file, with their controller; empty where it has none."""
    paths = times.files(run)
    every = times.read(paths[0]) if paths else pd.DataFrame()
    if not set(COLUMNS) <= set(every):
        return pd.DataFrame(columns=COLUMNS)
    own = every[every["arm"].astype(str) != ""]
    names = own["contender"].astype(str)
    return own.assign(controller=names.str.partition("+")[0], contender=names, inverse=own["inverse"].astype(str))


def loops(found: pd.DataFrame) -> pd.DataFrame:
    """Our engine's closed loops on one thread that could be timed."""
    if found.empty:
        return found
    return found[(found["what"] == "engine") & (found["engine"] == "native") & (found["ticks"] > 0)]


def is_standard(found: pd.DataFrame) -> pd.Series:
    """Whether each row is by the inverse that its arm and controller take if none is named."""
    parts = zip(found["arm"].astype(str), found["controller"], found["inverse"], strict=True)
    taken = [arm_rows.standard(arm, *controller.split("@")) == inverse for arm, controller, inverse in parts]
    return pd.Series(taken, found.index, dtype=bool)


def by_arm(found: pd.DataFrame) -> html.Markdown:
    """A row an arm: time a tick of the open loop, of our loops from the cheapest to the dearest, of dm_control's."""
    lines = []
    for arm in sorted(set(found["arm"].astype(str))):
        mine = found[found["arm"] == arm]
        own = loops(mine)
        if own.empty:
            continue
        took, over = own["ns_per_tick"] / 1e3, own["ratio_rollout"]
        open_loop, other = (mine[mine["engine"] == engine] for engine in ("rollout", "dm-control"))
        lines.append(
            {
                "Arm": arm_looks.title(arm),
                "Rollout [µs]": first(open_loop["ns_per_tick"] / 1e3),
                "Ours [µs]": f"{took.min():.2f} to {took.max():.2f}",
                "Over rollout": f"{over.min():.2f} to {over.max():.2f}",
                "dm_control [µs]": first(other["ns_per_tick"] / 1e3),
                "Times as long": first(other["speedup"]),
                "Two threads": first(mine.loc[mine["what"] == "threads", "speedup"]),
            }
        )
    return TIMES(lines) or html.Markdown(f"| No timings |\n| :-- |\n| {NONE_YET} |")


def first(values: pd.Series) -> float | None:
    """The only one, if there is one."""
    return values.iloc[0] if len(values) else None


def duration(run: Run) -> str:
    """On which machine; and how much longer a loop by (3.7) takes than one by (2.2), with the standard inverse."""
    own = loops(rows(run))
    if own.empty:
        return NONE_YET
    own, parts = own[is_standard(own)], []
    for arm, mine in own.groupby(own["arm"].astype(str)):
        by = mine.set_index("controller")["ns_per_tick"]
        if set(arm_rows.PAPERS_TWO) <= set(by.index):
            parts.append((arm_looks.title(str(arm)), by[arm_rows.ON_ANGLES] / by[arm_rows.ON_MATRIX] - 1.0))
    if not parts:
        return times.said(run)
    low, high = (f(parts, key=lambda part: part[1]) for f in (min, max))
    return (
        f"{times.said(run)} A whole loop by (3.7) takes {100 * low[1]:.0f} % ({low[0]}) to "
        f"{100 * high[1]:.0f} % ({high[0]}) longer than one by (2.2) with the rotation matrix."
    )

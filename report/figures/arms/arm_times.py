"""Time a tick of closed loops on arms: our engine's, over MuJoCo's open loop on the same model, and dm_control's."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.arms.arm_poses import look as look_of_arm
from report.figures.arms.arm_poses import title as title_of_arm
from report.figures.cost import times
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

NONE_YET = "No closed loop on an arm has been timed yet: `make time` does."
COLUMNS = ("arm", "jacobian", "inverse", "ratio_rollout")


def rows() -> pd.DataFrame:
    """Rows about arms of the first machine's file, with their controller; empty where it has none."""
    paths = times.files()
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


def labelled(found: pd.DataFrame) -> pd.Series:
    """Controller and inverse, as a figure names them; without the inverse that is taken if none is named."""
    inverses = found["inverse"].map(arm_rows.title_of_inverse)
    named = found["controller"].map(arm_rows.title)
    return named.where(is_standard(found), named + ": " + inverses.str[:1].str.lower() + inverses.str[1:])


def is_standard(found: pd.DataFrame) -> pd.Series:
    """Whether each row is by the inverse that its arm and controller take if none is named."""
    parts = zip(found["arm"].astype(str), found["controller"], found["inverse"], strict=True)
    taken = [arm_rows.standard(arm, *controller.split("@")) == inverse for arm, controller, inverse in parts]
    return pd.Series(taken, found.index, dtype=bool)


@responsive_picture
def ratios(found: pd.DataFrame, *, narrow=False):
    """Time a tick over mujoco.rollout's, a row a controller and inverse, a mark an arm with its interval."""
    own = loops(found)
    if own.empty:
        return style.words(NONE_YET.replace("`", ""), narrow), NONE_YET
    labels = labelled(own)
    order = own.groupby(labels)["ratio_rollout"].median().sort_values(kind="stable").index.tolist()
    figure, axes = style.panels(height=1.2 + (0.42 if narrow else 0.26) * len(order), narrow=narrow)
    for place, arm in enumerate(sorted(set(own["arm"].astype(str)))):
        mine, look = own[own["arm"] == arm], look_of_arm(arm)
        y = [order.index(label) + 0.14 * (place - 1.5) for label in labels[mine.index]]
        low, high = (
            mine["ratio_rollout"] - mine["ratio_rollout_low"],
            mine["ratio_rollout_high"] - mine["ratio_rollout"],
        )
        axes.errorbar(
            mine["ratio_rollout"],
            y,
            xerr=[low.clip(lower=0), high.clip(lower=0)],
            color=look.colour,
            marker=look.marker,
            linestyle="none",
            linewidth=1.2,
            label=title_of_arm(arm),
        )
    axes.axvline(1.0, color=style.MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    if narrow:
        axes.set_yticks([])
        for place, name in enumerate(order):
            axes.text(0.0, place - 0.3, name, va="bottom", fontsize=8, transform=axes.get_yaxis_transform())
    else:
        axes.set_yticks(range(len(order)), order, fontsize=8.5)
    axes.set_xlabel("Time a tick, closed loop over mujoco.rollout")
    axes.set_ylim(len(order) - 0.4, -0.8)
    axes.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper left", ncols=1 if narrow else 4)
    words = "; ".join(
        f"{title_of_arm(arm)} {mine['ratio_rollout'].min():.2f} to {mine['ratio_rollout'].max():.2f}"
        for arm, mine in own.groupby(own["arm"].astype(str))
    )
    return figure, f"Time a tick of closed loops over the open loop of mujoco.rollout: {words}."

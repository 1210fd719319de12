"""Responses on arms: the angle to the goal against time, and Euler angles under (3.7) beside their closed form."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from report.figures.arms import arm_rows
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, given
from report.figures.responses.responses import ANGLES, euler_deg, gains
from tasks.paths import zyx_angles

SHOWN_S = 1.2
"""Two settling times of a small error, as on the free body."""

CURVES = {
    arm_rows.ON_MATRIX: style.SOLID,
    "linearized-euler/zyx-euler@geometric": style.DASHED,
    arm_rows.ON_ANGLES: style.DASH_DOT,
    "feedback-linearized/mrp@analytic": style.DOTTED,
}
"""The paper's three laws, and (3.7) in coordinates that have no pole."""
OTHER = "#cc79a7"
TOP_DEG = 200.0
LABEL_HEIGHT = 0.1
"""Of a Greek letter beside its curve, over what the curves of a panel span."""


@functools.cache
def curves(run: Run) -> pd.DataFrame:
    """Traces of the run on arms; maybe none."""
    found = run.rows("traces", task="arm-regulation")
    return arm_rows.named(found) if len(found) else found


def facts(run: Run) -> dict:
    """Gains, and how far any angle under (3.7) leaves its closed form."""
    traces, episodes = curves(run), arm_rows.episodes(run)
    if traces.empty:
        return given(episodes, gains) or {}
    found = bends(traces, episodes, **gains(episodes))
    worst = found.loc[found["bend_deg"].idxmax()]
    far = {"bend": f"{worst['bend_deg']:.2g}", "bend_n": int(found["n"].sum()), "bend_arm": worst["arm"]}
    return {**gains(episodes), **far}


def figures(run: Run) -> dict:
    """Angles to the goal; Euler angles."""
    traces, episodes = curves(run), arm_rows.episodes(run)
    if traces.empty:
        return {}
    return {"arm-angles": angles(traces, episodes), "arm-linear": linear(traces, episodes, **gains(episodes))}


def colour(controller: str) -> str:
    """A controller's colour here: its law's, but of two feedback-linearized ones the second has another."""
    is_another = controller.startswith("feedback-linearized/") and controller != arm_rows.ON_ANGLES
    return OTHER if is_another else style.look(controller).colour


def firsts(traces: pd.DataFrame, start_set: str, most: int = 1) -> dict[str, list[str]]:
    """Arm -> the first starts of a set of which the run holds curves."""
    rows = traces[traces["start_set"] == start_set]
    return {arm: list(dict.fromkeys(own["start_id"].astype(str)))[:most] for arm, own in rows.groupby("arm")}


def curve(traces: pd.DataFrame, arm: str, start_id: str, controller: str) -> pd.DataFrame:
    """One episode by the standard inverse, from its beginning on."""
    rows = arm_rows.of(traces[(traces["arm"] == arm) & (traces["start_id"] == start_id)], controller)
    return rows[rows["time_s"] <= SHOWN_S].sort_values("time_s")


def finished(episodes: pd.DataFrame, arm: str, start_id: str, controller: str) -> str:
    """How that episode ended, in a word; empty if the run has it not."""
    rows = arm_rows.of(episodes[(episodes["arm"] == arm) & (episodes["start_id"] == start_id)], controller)
    return str(rows["outcome"].iloc[0]) if len(rows) else ""


@responsive_picture
def angles(traces: pd.DataFrame, episodes: pd.DataFrame, narrow: bool):
    """Angle to the goal against time from one clear and one pole start of each arm.

    Args:
        traces: of `arm_rows.named`. episodes: of `arm_rows.episodes`, for how each ended.
    """
    sets = [name for name in ("clear", "pole") if name in set(traces["start_set"].astype(str))]
    names = arm_rows.arms(traces)
    figure, grid = style.panels(
        len(names),
        len(sets),
        height=1.7 * len(names) + (1.3 if narrow else 0.8),
        narrow=narrow,
        sharex=True,
        squeeze=False,
    )
    said = []
    for k, name in enumerate(sets):
        starts = firsts(traces, name)
        for i, arm in enumerate(names):
            axes, [start_id] = grid[i, k], starts[arm]
            ends = [_draw(axes, traces, episodes, arm, start_id, controller) for controller in CURVES]
            axes.set(xlim=(0, SHOWN_S), ylim=(0, None), title=f"{arm}, {name}")
            axes.set_ylim(0, min(TOP_DEG, axes.get_ylim()[1]))
            said.append(f"{arm} from {start_id}: {'; '.join(filter(None, ends))}")
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    for controller, line in CURVES.items():
        grid[0, 0].plot([], [], color=colour(controller), linestyle=line, label=arm_rows.title(controller))
    grid[0, 0].plot([], [], "x", color=style.INK, label="fails", markersize=6)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=1 if narrow else 3)
    style.label_rows(figure, "angle to the goal [deg]")
    return figure, f"Angle to the goal against time. {'. '.join(said)}."


def _draw(axes, traces, episodes, arm: str, start_id: str, controller: str) -> str:
    own = curve(traces, arm, start_id, controller)
    if own.empty:
        return ""
    angle = np.degrees(own["angle_rad"])
    axes.plot(own["time_s"], angle, color=colour(controller), linestyle=CURVES[controller], linewidth=1.5)
    outcome = finished(episodes, arm, start_id, controller)
    if outcome not in ("", "settled") and own["time_s"].iloc[-1] < SHOWN_S - 0.1:
        axes.plot(own["time_s"].iloc[-1], angle.iloc[-1], "x", color=colour(controller), markersize=7)
    return f"{arm_rows.title(controller)} from {angle.iloc[0]:.0f} degrees, {outcome}"


@responsive_picture
def linear(traces: pd.DataFrame, episodes: pd.DataFrame, kp: float, kv: float, narrow: bool):
    """Z-Y-X angles under (3.7) from a clear start of each arm, on their closed form.

    Args:
        traces: of `arm_rows.named`. episodes: of `arm_rows.episodes`, for the goals. kp, kv: of the closed form.
    """
    names = arm_rows.arms(traces)
    figure, grid = style.grid(len(names), 1.9, 1.9, narrow, top=0.4)
    fine = np.linspace(0.0, SHOWN_S, 200)
    shape, shade = closed_form.linear(fine, kp, kv), style.look(arm_rows.ON_ANGLES).colour
    said = []
    for axes, arm in zip(grid.flat, names, strict=False):
        own, goal = shown(traces, episodes, arm)
        times, measured = own["time_s"].to_numpy(), off_goal_deg(own, goal)
        beside = style.apart(measured[0], LABEL_HEIGHT * np.ptp([*measured[0], 0.0]))
        for i, (_, symbol, line) in enumerate(ANGLES):
            axes.plot(times, measured[:, i], color=shade, linestyle=line)
            axes.plot(fine, measured[0, i] * shape, color=style.INK, linewidth=0.8, linestyle=style.DASHED)
            style.label_line(axes, -0.02, beside[i], symbol, shade, ha="right", fontsize=11)
        axes.axhline(0.0, color=style.MUTED, linewidth=0.7)
        axes.set(title=arm, xlim=(-0.1, SHOWN_S))
        said.append(f"{arm} is at most {bend_deg(own, goal, kp, kv):.2g} degrees from its closed form")
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    style.label_rows(figure, "Z-Y-X angle to go [deg]")
    return figure, f"Euler angles under (3.7) from one clear start of each arm: {', '.join(said)}."


def off_goal_deg(own: pd.DataFrame, goal: pd.Series) -> np.ndarray:
    """Z-Y-X angles minus those of the goal [deg], a row a sample."""
    return euler_deg(own) - np.degrees(zyx_angles(tuple(goal[[f"goal_quat_{axis}" for axis in "wxyz"]])))


def bend_deg(own: pd.DataFrame, goal: pd.Series, kp: float, kv: float) -> float:
    """Largest distance of an angle from its closed form [deg]."""
    measured = off_goal_deg(own, goal)
    return float(np.abs(measured - measured[0] * closed_form.linear(own["time_s"], kp, kv)[:, None]).max())


def shown(traces: pd.DataFrame, episodes: pd.DataFrame, arm: str) -> tuple[pd.DataFrame, pd.Series]:
    """The curve that `linear` draws of an arm, and its row of the episodes."""
    [start_id] = firsts(traces, "clear")[arm]
    rows = arm_rows.of(episodes[(episodes["arm"] == arm) & (episodes["start_id"] == start_id)], arm_rows.ON_ANGLES)
    return curve(traces, arm, start_id, arm_rows.ON_ANGLES), rows.iloc[0]


def bends(traces: pd.DataFrame, episodes: pd.DataFrame, kp: float, kv: float) -> pd.DataFrame:
    """An arm a row: largest distance from the closed form of every clear start under (3.7), and n."""
    lines = []
    for arm, starts in firsts(traces, "clear", most=len(traces)).items():
        parts = []
        for start_id in starts:
            own = curve(traces, arm, start_id, arm_rows.ON_ANGLES)
            here = episodes[(episodes["arm"] == arm) & (episodes["start_id"] == start_id)]
            if len(own) and len(here):
                parts.append(bend_deg(own, here.iloc[0], kp, kv))
        lines.append({"arm": arm, "n": len(parts), "bend_deg": max(parts)})
    return pd.DataFrame(lines)

"""Figures 2.3 to 2.5 of the paper drawn again: an episode's Euler angles, and its angle to the goal, against time."""

import functools
import math
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.tables.run import Run, choose_rows
from bench.findings.claims.places import euler_angles_along
from bench.findings.theory import closed_form
from report.figures.kit import laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX, gains
from report.figures.kit.quotes import quote
from report.figures.kit.spelling import power

ANGLES = (
    ("alpha", "α", style.SOLID),
    ("beta", "β", style.DASH_DOT),
    ("gamma", "γ", style.DOTTED),
)
SHOWN_S = 1.2
"""Two settling times of a small error: all there is to see."""

FIGURES = {"3": MATRIX, "4": LINEARIZED, "5": FEEDBACK}
"""Last digit of the paper's figure and of its start -> its law."""

NAMES = {MATRIX: "the rotation-matrix law", LINEARIZED: "the linearized law", FEEDBACK: "feedback linearization"}
"""What a sentence calls the law of a figure."""

QUOTED = {"3": "C01", "4": "C38", "5": "C09"}
"""Last digit of the paper's figure -> the claim whose sentence describes it."""

TURN_DEG = 90.0
"""Unit of the common axis of angles."""

AWAY_DEG = 1.0
"""A body that turns further from the goal than this turns away from it, visibly."""


class LawResponse(NamedTuple):
    """What one law does from the start of its figure.

    Attributes:
        law: Name of the contender.
        trace: Samples up to SHOWN_S.
        row: Its episode.
        bend_deg: Largest distance of each Euler angle from the linear response, over the whole trace.
        peak_deg: Largest angle to the goal, over the whole trace.
    """

    law: str
    trace: pd.DataFrame
    row: pd.Series
    bend_deg: np.ndarray
    peak_deg: float

    @property
    def first_deg(self) -> float:
        """Return the angle to the goal at the start."""
        return float(np.degrees(self.trace["angle_rad"].iloc[0]))


class AxisLimits(NamedTuple):
    """The axes that all figures share [deg].

    Attributes:
        euler: Greatest Euler angle, of both signs.
        goal: Greatest angle to the goal.
    """

    euler: float
    goal: float


@functools.cache
def drawn(run: Run) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Traces and episodes of the starts of the paper's figures, on the continuous plant."""
    words = {"engine": "ideal-rk4", "start_set": "paper"}
    return run.rows("traces", **words), run.rows("episodes", **words)


def facts(run: Run) -> dict[str, Any]:
    """Return the paper's figures, each with its start, the paper's sentence and the finding."""
    traces, episodes = drawn(run)
    kp, kv = gains(episodes)
    found = {end: measure_response(traces, episodes, end, kp, kv) for end in FIGURES}
    limits = find_limits(list(found.values()))
    values: dict[str, Any] = {"kp": kp, "kv": kv}
    for end, response in found.items():
        values[f"figure_{end}"] = draw_response(response, kp, kv, limits)
        values[f"quote_{end}"] = quote(QUOTED[end])
        values[f"start_{end}"] = describe_start(response.row)
        values[f"finding_{end}"] = describe_finding(response)
    return values


def measure_response(
    traces: pd.DataFrame, episodes: pd.DataFrame, end: str, kp: float, kv: float
) -> LawResponse:
    """Return what the law of a figure does from the figure's start."""
    law = FIGURES[end]
    at = {"start_id": f"figure-2.{end}", "contender": law}
    trace = choose_rows(traces, at)
    row = choose_rows(episodes, at).iloc[0]
    peak_deg = float(np.degrees(trace["angle_rad"].max()))
    shown = trace[trace["time_s"] <= SHOWN_S]
    return LawResponse(law, shown, row, bend_deg(trace, kp, kv), peak_deg)


def find_limits(responses: list[LawResponse]) -> AxisLimits:
    """Return axes that hold all responses."""
    euler = max(float(np.abs(euler_deg(response.trace)).max()) for response in responses)
    goal = max(response.peak_deg for response in responses)
    return AxisLimits(round_up(euler), round_up(goal))


def round_up(angle_deg: float) -> float:
    """Return the next multiple of the unit of the axis."""
    return TURN_DEG * math.ceil(angle_deg / TURN_DEG)


def describe_start(row: pd.Series) -> str:
    """Return the start's Euler angles [rad]."""
    angles = [f"{row[f'{name}0']:.3g}" for name, *_ in ANGLES]
    return ", ".join(angles).replace("-", "\N{MINUS SIGN}")


def describe_finding(response: LawResponse) -> str:
    """Say how close to the linear response the angles stay, how long the body takes, and by which way."""
    bend = float(response.bend_deg.max())
    distance = f"{bend:.0f}°" if bend > 1.0 else f"{power(bend)} deg"
    row = response.row
    settles = "never settles"
    if row["outcome"] == "settled":
        settles = f"settles in {row['settling_time_s']:.3f} s"
    away = ""
    if response.peak_deg > response.first_deg + AWAY_DEG:
        away = f" The body first turns away from the goal, from {response.first_deg:.0f}° to {response.peak_deg:.0f}°."
    return (
        f"With {NAMES[response.law]}, the Euler angles stay within {distance} of the linear response. The body "
        f"{settles}, on a path that is {row['path_ratio']:.2f} times as long as the shortest path.{away}"
    )


def euler_deg(trace: pd.DataFrame) -> np.ndarray:
    """Z-Y-X Euler angles [deg] of every sample, one row each, unwrapped from the first."""
    return np.degrees(np.unwrap(euler_angles_along(trace), axis=0))


@responsive_picture
def draw_response(
    response: LawResponse, kp: float, kv: float, limits: AxisLimits, narrow: bool
) -> Drawing:
    """Draw one law's Euler angles, dashed their linear closed form; beside them its angle to the goal."""
    shape = (2, 1) if narrow else (1, 2)
    figure, (left, right) = style.panels(*shape, height=4.6 if narrow else 2.1, narrow=narrow)
    times = response.trace["time_s"].to_numpy()
    angles = euler_deg(response.trace)
    goal = np.degrees(response.trace["angle_rad"].to_numpy())
    fine = np.linspace(0.0, SHOWN_S, 200)
    linear = closed_form.linear(fine, kp, kv)
    colour = style.look(response.law).colour
    dashed: dict[str, Any] = {"color": style.MUTED, "linewidth": 0.9, "linestyle": style.DASHED}
    heights = style.apart([*angles[0]], limits.euler / 3.0)
    for i, (_, symbol, line) in enumerate(ANGLES):
        left.plot(fine, angles[0, i] * linear, **dashed)
        left.plot(times, angles[:, i], color=colour, linestyle=line)
        style.label_line(left, -0.04, heights[i], symbol, colour, ha="right", fontsize=11)
    right.plot(fine, goal[0] * linear, **dashed)
    right.plot(times, goal, color=colour)
    left.set(xlim=(-0.17, SHOWN_S), ylim=(-limits.euler, limits.euler), ylabel="Euler angle [deg]")
    right.set(xlim=(-0.17, SHOWN_S), ylim=(0.0, limits.goal), ylabel="angle to the goal [deg]")
    left.set_yticks(np.arange(-limits.euler, limits.euler + 1.0, TURN_DEG))
    right.set_yticks(np.arange(0.0, limits.goal + 1.0, TURN_DEG / 2.0))
    for axes in (left, right) if not narrow else (right,):
        axes.set_xlabel("time [s]")
    return figure, describe_picture(response, angles[0], goal)


def describe_picture(response: LawResponse, first: np.ndarray, goal: np.ndarray) -> str:
    """Return the alternative text."""
    names = [name for name, *_ in ANGLES]
    begins = ", ".join(f"{name} {angle:.0f}" for name, angle in zip(names, first, strict=True))
    bends = ", ".join(f"{name} {bend:.2g}" for name, bend in zip(names, response.bend_deg, strict=True))
    return (
        f"{laws.TITLES[response.law]} from {begins} degrees. Distance from the linear form, in "
        f"degrees: {bends}. Its angle to the goal begins at {goal[0]:.0f}, peaks at "
        f"{goal.max():.0f}, ends at {goal[-1]:.2g} degrees."
    )


def bend_deg(trace: pd.DataFrame, kp: float, kv: float) -> np.ndarray:
    """Largest distance [deg] of each Euler angle of an episode from its linear closed form."""
    angles = euler_deg(trace)
    linear = closed_form.linear(trace["time_s"].to_numpy(), kp, kv)
    return np.abs(angles - angles[0] * linear[:, None]).max(axis=0)

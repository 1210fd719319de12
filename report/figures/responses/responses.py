"""Figures 2.3 to 2.5 of the paper drawn again: an episode's Euler angles, and its angle to the goal, against time."""

import functools
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.tables.read import chosen
from bench.findings.claims.probes import euler_angles_along
from bench.findings.theory import closed_form
from report.figures.kit import laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.laws import FEEDBACK, LINEARIZED, MATRIX, gains
from report.figures.kit.page import Run
from report.figures.kit.spelling import power

ANGLES = (
    ("alpha", r"$\alpha$", style.SOLID),
    ("beta", r"$\beta$", style.DASH_DOT),
    ("gamma", r"$\gamma$", style.DOTTED),
)
SHOWN_S = 1.2
"""Two settling times of a small error: all there is to see."""

FIGURES = {"3": MATRIX, "4": LINEARIZED, "5": FEEDBACK}
"""Last digit of the paper's figure and of its start -> its law."""


@functools.cache
def drawn(run: Run) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Traces and episodes of the starts of the paper's figures, on the continuous plant."""
    words = {"engine": "ideal-rk4", "start_set": "paper"}
    return run.rows("traces", **words), run.rows("episodes", **words)


def facts(run: Run) -> dict:
    """Return the paper's figures as one, the start of each, and how far, how long and how straight its law goes."""
    traces, episodes = drawn(run)
    kp, kv = gains(episodes)
    values: dict = {"kp": kp, "kv": kv, "figures": responses(traces, kp, kv)}
    for end, law in FIGURES.items():
        at = {"start_id": f"figure-2.{end}", "contender": law}
        followed, row = chosen(traces, at), chosen(episodes, at).iloc[0]
        values[f"start_{end}"] = ", ".join(f"{row[f'{angle}0']:.3g}" for angle, *_ in ANGLES).replace("-", "\u2212")
        bend = float(bend_deg(followed, kp, kv).max())
        values[f"bend_{end}"] = f"{bend:.0f}" if bend > 1.0 else power(bend)
        values[f"time_{end}"], values[f"path_{end}"] = f"{row['settling_time_s']:.3f}", f"{row['path_ratio']:.2f}"
    angles = np.degrees(followed["angle_rad"])
    return values | {"first_5": f"{angles.iloc[0]:.0f}", "peak_5": f"{angles.max():.0f}"}


def euler_deg(trace: pd.DataFrame) -> np.ndarray:
    """Z-Y-X Euler angles [deg] of every sample, one row each, unwrapped from the first."""
    return np.degrees(np.unwrap(euler_angles_along(trace), axis=0))


@responsive_picture
def responses(traces: pd.DataFrame, kp: float, kv: float, narrow: bool) -> Drawing:
    """Draw each law from its figure's start: angles, dashed their linear closed form; below, the angle to the goal."""
    shape = (3, 2) if narrow else (2, 3)
    figure, grid = style.panels(*shape, height=8.4 if narrow else 4.6, narrow=narrow, sharex=True)
    pairs = grid if narrow else grid.T
    said = [
        draw_response(pair, chosen(traces, {"start_id": f"figure-2.{end}", "contender": law}), end, kp, kv)
        for pair, (end, law) in zip(pairs, FIGURES.items(), strict=True)
    ]
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    for upper, lower in pairs if narrow else pairs[:1]:
        upper.set_ylabel("Euler angle [deg]")
        lower.set_ylabel("angle to the goal [deg]")
    return figure, " ".join(said)


def draw_response(pair: Any, own: pd.DataFrame, end: str, kp: float, kv: float) -> str:
    """Draw one law's Euler angles, and in the second panel its angle to the goal; return what they show."""
    own, (upper, lower) = own[own["time_s"] <= SHOWN_S], pair
    name = own["contender"].iloc[0]
    times, angles, goal = own["time_s"].to_numpy(), euler_deg(own), np.degrees(own["angle_rad"].to_numpy())
    fine, colour = np.linspace(0.0, SHOWN_S, 200), style.look(name).colour
    linear = closed_form.linear(fine, kp, kv)
    dashed = {"color": style.MUTED, "linewidth": 0.9, "linestyle": style.DASHED}
    for i, (_, symbol, line) in enumerate(ANGLES):
        upper.plot(fine, angles[0, i] * linear, **dashed)
        upper.plot(times, angles[:, i], color=colour, linestyle=line)
        style.label_line(upper, -0.03, angles[0, i], symbol, colour, ha="right", fontsize=10)
    upper.set(xlim=(-0.2, SHOWN_S), title=f"2.{end}: {laws.TITLES[name]}")
    lower.plot(fine, goal[0] * linear, **dashed)
    lower.plot(times, goal, color=colour)
    lower.set_ylim(0, None)
    begins = ", ".join(f"{word} {value:.0f}" for (word, *_), value in zip(ANGLES, angles[0], strict=True))
    bends = ", ".join(f"{word} {value:.2g}" for (word, *_), value in zip(ANGLES, bend_deg(own, kp, kv), strict=True))
    return (
        f"{laws.TITLES[name]} from {begins} degrees. Distance from the linear form, in degrees: {bends}. "
        f"Its angle to the goal begins at {goal[0]:.0f}, peaks at {goal.max():.0f}, ends at {goal[-1]:.2g} degrees."
    )


def bend_deg(trace: pd.DataFrame, kp: float, kv: float) -> np.ndarray:
    """Largest distance [deg] of each Euler angle of an episode from its linear closed form."""
    angles = euler_deg(trace)
    return np.abs(angles - angles[0] * closed_form.linear(trace["time_s"].to_numpy(), kp, kv)[:, None]).max(axis=0)

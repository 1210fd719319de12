"""Figures 2.3 to 2.5 of the paper drawn again: an episode's Euler angles, and its angle to the goal, against time."""

import functools
from typing import Any

import numpy as np
import pandas as pd

from bench.findings.theory import closed_form
from bench.law.contenders.representations.zyx_euler import chart
from bench.law.so3 import Rotation
from report.figures.kit import laws, style
from report.figures.kit.inline import Drawing, responsive_picture
from report.figures.kit.page import Run
from report.figures.kit.rows import SHORT

ANGLES = (
    ("alpha", r"$\alpha$", style.SOLID),
    ("beta", r"$\beta$", style.DASH_DOT),
    ("gamma", r"$\gamma$", style.DOTTED),
)
SHOWN_S = 1.2
"""Two settling times of a small error: all there is to see."""

FIGURES = {"response-matrix": ("m", "3"), "response-linearized": ("l", "4"), "response-feedback": ("f", "5")}
"""Figure -> the letter of its law, and the last digit of the paper's figure and of the start."""


@functools.cache
def drawn(run: Run) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Traces and episodes of the starts of the paper's figures, on the continuous plant."""
    words = {"engine": "ideal-rk4", "start_set": "paper"}
    return run.rows("traces", **words), run.rows("episodes", **words)


def gains(episodes: pd.DataFrame) -> dict[str, float]:
    """Return the gains of the closed form."""
    return {name: float(episodes[name].iloc[0]) for name in ("kp", "kv")}


def facts(run: Run) -> dict:
    """Return the start of each figure, and how far, how long and how straight its law goes from there."""
    traces, episodes = drawn(run)
    values: dict = gains(episodes)
    for letter, end in FIGURES.values():
        at = {"start_id": f"figure-2.{end}", "contender": SHORT[letter]}
        followed, row = find(traces, at), find(episodes, at).iloc[0]
        values[f"start_{end}"] = ", ".join(f"{row[f'{angle}0']:.3g}" for angle, *_ in ANGLES)
        values[f"bend_{end}"] = float(bend_deg(followed, **gains(episodes)).max())
        values[f"time_{end}"], values[f"path_{end}"] = f"{row['settling_time_s']:.3f}", f"{row['path_ratio']:.2f}"
    angles = np.degrees(followed["angle_rad"])
    return values | {"first_5": f"{angles.iloc[0]:.0f}", "peak_5": f"{angles.max():.0f}"}


def find(rows: pd.DataFrame, words: dict[str, str]) -> pd.DataFrame:
    """Return the rows that have these words."""
    return rows[(rows[list(words)].astype(str) == pd.Series(words)).all(axis=1)]


def figures(run: Run) -> dict:
    """Return the paper's figures 2.3 to 2.5."""
    traces, episodes = drawn(run)
    return {
        name: response(traces, SHORT[letter], f"figure-2.{end}", **gains(episodes))
        for name, (letter, end) in FIGURES.items()
    }


def euler_deg(trace: pd.DataFrame) -> np.ndarray:
    """Z-Y-X Euler angles [deg] of every sample, one row each, unwrapped from the first."""
    columns = [[f"{c}_{x}" for x in "xyz"] for c in "noa"]
    samples = zip(*(trace[names].itertuples(index=False, name=None) for names in columns), strict=True)
    angles = np.array([chart(Rotation(*columns)).E for columns in samples])
    return np.degrees(np.unwrap(angles, axis=0))


@responsive_picture
def response(traces: pd.DataFrame, contender: str, start_id: str, kp: float, kv: float, narrow: bool) -> Drawing:
    """One law from one start: its angles with the linear closed form, and the angle to the goal of all three laws.

    Args:
        traces: rows of one engine. kp, kv: gains of the closed form, dashed.
    """
    episode = traces[(traces["start_id"] == start_id) & (traces["time_s"] <= SHOWN_S)]
    own = episode[episode["contender"] == contender]
    times, angles = own["time_s"].to_numpy(), euler_deg(own)
    figure, (left, right) = style.beside(2, 3.0, 5.4, narrow, sharex=True)
    fine = np.linspace(0.0, SHOWN_S, 200)
    linear = closed_form.linear(fine, kp, kv)
    colour = style.look(contender).colour
    for i, (_, symbol, line) in enumerate(ANGLES):
        left.plot(fine, angles[0, i] * linear, color=style.MUTED, linewidth=0.9, linestyle=style.DASHED)
        left.plot(times, angles[:, i], color=colour, linestyle=line)
        style.label_line(left, -0.02, angles[0, i], symbol, colour, ha="right", fontsize=11)
    left.axhline(0.0, color=style.MUTED, linewidth=0.7)
    left.set(ylabel="Z-Y-X Euler angle [deg]", xlim=(-0.1, SHOWN_S), title=laws.TITLES[contender])
    ends = _angle_to_goal(right, episode)
    first = np.degrees(own["angle_rad"].iloc[0])
    right.plot(fine, first * linear, color=style.MUTED, linewidth=0.9, linestyle=style.DASHED)
    right.set(ylabel="angle to the goal [deg]", ylim=(0, None), title="All three, from the same start")
    for axes in (left, right) if not narrow else (right,):
        axes.set_xlabel("time [s]")
    begins = ", ".join(f"{name} {value:.0f}" for (name, *_), value in zip(ANGLES, angles[0], strict=True))
    bends = ", ".join(f"{name} {value:.2g}" for (name, *_), value in zip(ANGLES, bend_deg(own, kp, kv), strict=True))
    return figure, (
        f"{laws.TITLES[contender]} from {begins} degrees: the angles against time. Largest distance from the "
        f"linear closed form, in degrees: {bends}. Beside it the angle to the goal for each law, from {first:.0f} "
        f"degrees; at {SHOWN_S} s {ends}."
    )


def _angle_to_goal(axes: Any, episode: pd.DataFrame) -> str:
    said = []
    for name, title, rows in laws.each(episode):
        look = style.look(name)
        angle = np.degrees(rows["angle_rad"])
        axes.plot(rows["time_s"], angle, color=look.colour, linestyle=look.line, label=title)
        said.append(f"{title} is at {angle.iloc[-1]:.2g} degrees")
    axes.legend(loc="upper right")
    return ", ".join(said)


def bend_deg(trace: pd.DataFrame, kp: float, kv: float) -> np.ndarray:
    """Largest distance [deg] of each Euler angle of an episode from its linear closed form."""
    angles = euler_deg(trace)
    return np.abs(angles - angles[0] * closed_form.linear(trace["time_s"].to_numpy(), kp, kv)[:, None]).max(axis=0)

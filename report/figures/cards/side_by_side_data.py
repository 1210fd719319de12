"""Every law from every telling start, as whole numbers: what report/_extra/side-by-side.js draws.

A curve holds, every step_s: the angle to the goal, the size of the command, and the rotation vector of R R_d^T in the
base frame, whose length is that angle. What has no number (a command on a singular set) is null.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation as Turn

from bench.experiments.traces import EVERY_S, TELLING
from report.figures.cost.operations import CALLS
from report.figures.kit import families, html, laws, style
from tasks.rules import RULES

ANGLE_UNIT = 1e-6
"""rad: a logarithmic axis that ends at a hundredth of a degree shows it without steps."""

COMMAND_UNIT = 1e-2
"""rad/s^2; a command beyond the judge's limit is drawn at the limit."""

TURN_UNIT = 1e-3
"""rad: a third of a pixel in a ball of 400."""

NO_BREAK = "\N{NO-BREAK SPACE}"

NO_ROTATION = 1.001
"""Greatest element from which a sample is left out: a plant that spins away leaves SO(3) before it is stopped."""


class Start(NamedTuple):
    """A start as the page calls it."""

    id: str
    group: str
    title: str
    short: str


GROUPS = {
    "paper": "The paper's figures",
    "half-turn": "Half turns",
    "poles": "Poles and jumps of Z-Y-X angles",
    "wraps": "Poles and jumps of Z-Y-X angles",
    "goals": "Other goals",
    "tumbling": "Spinning",
    "uniform": "Anywhere",
}

# start -> in full, and as the head of a column; {angle} to go, at {speed}
TITLES = {
    "figure-2.3": ("Figure 2.3 of the paper, {angle} to go", "Figure 2.3"),
    "figure-2.4": ("Figure 2.4 of the paper, {angle} to go", "Figure 2.4"),
    "figure-2.5": ("Figure 2.5 of the paper, {angle} to go", "Figure 2.5"),
    "half-turn-random0-k02": ("Nearly half a turn: {angle}", "{angle}"),
    "half-turn-random0-k04": ("Very nearly half a turn: {angle}", "{angle}"),
    "half-turn-random0-exact": ("Exactly half a turn, about a tilted axis", "{angle}, tilted"),
    "half-turn-x-exact": ("Exactly half a turn, about x", "{angle}, x"),
    "pole-plus-k02-a2.5-g2.8": ("Beside a pole, {angle} to go", "Beside a pole"),
    "pole-plus-exact-twist-plus-1.0": ("Exactly on a pole, {angle} to go", "On a pole"),
    "wrap-gamma-plus-k02-b-0.9-o-1.5": ("Just before the jump of γ at 180°, {angle} to go", "Before a jump"),
    "goal-beyond-wrap-gamma-up": ("A goal beyond the jump of γ, {angle} away", "Goal beyond it"),
    "goal-uniform-0000": ("A goal far from zero, {angle} away", "Far goal"),
    "tumbling-0002": ("Spinning at {speed}, {angle} to go", "{speed}"),
    "tumbling-0006": ("Spinning at {speed}, {angle} to go", "{speed}"),
}
ANYWHERE = ("At rest anywhere, {angle} to go", "{angle}")


def shown(traces: pd.DataFrame) -> pd.DataFrame:
    """Rows of the free body from every start from which all laws are followed, in the order of TITLES.

    Returns:
        no row at all where the telling starts were not run.
    """
    free = traces[traces["task"] == "free-body"]
    if not free["start_set"].isin(list(TELLING)).any():
        return free.iloc[:0]
    followed = free.groupby("start_id", observed=True)["contender"].nunique()
    common = free[free["start_id"].isin(followed.index[followed == followed.max()])]
    places = {start_id: place for place, start_id in enumerate(TITLES)}
    place = common["start_id"].astype(str).map(places).fillna(len(places))
    return common.iloc[place.argsort(kind="stable")]


def starts(rows: pd.DataFrame, episodes: pd.DataFrame) -> list[Start]:
    """The starts of `shown`, in its order, with the numbers of their titles.

    Args:
        episodes: any law's from these starts; their goals and initial speeds are the start's own.
    """
    firsts = rows.drop_duplicates("start_id")
    given = episodes.drop_duplicates("start_id").set_index("start_id")
    found = []
    for start_set, start_id in zip(firsts["start_set"], firsts["start_id"], strict=True):
        one = given.loc[start_id]
        speed = math.hypot(*one[["omega0_x", "omega0_y", "omega0_z"]])
        numbers = {"angle": degrees(one["angle0_rad"]), "speed": f"{speed:.0f} rad/s"}
        title, short = TITLES.get(start_id, ANYWHERE)
        found.append(Start(start_id, GROUPS[start_set], title.format(**numbers), short.format(**numbers)))
    return found


def data(rows: pd.DataFrame, episodes: pd.DataFrame, costs: pd.DataFrame) -> dict:
    """All that the script reads.

    Args:
        rows: of `shown`. episodes: see `starts`. costs: rows about the free body.
    """
    goals = episodes.drop_duplicates("start_id").set_index("start_id")
    goals = goals[[f"goal_quat_{axis}" for axis in "xyzw"]]
    curves: dict = {}
    for (name, start_id), own in rows.groupby(["contender", "start_id"], observed=True):
        curves.setdefault(name, {})[start_id] = curve(own, Turn.from_quat(goals.loc[start_id]))
    return {
        "step_s": EVERY_S,
        "units": {"angle": ANGLE_UNIT, "command": COMMAND_UNIT, "turn": TURN_UNIT},
        "band": RULES.tolerance,
        "laws": {name: law(name, costs) for name in families.in_order(curves)},
        "starts": {one.id: one.title for one in starts(rows, episodes)},
        "curves": curves,
    }


def law(name: str, costs: pd.DataFrame) -> dict:
    """How a law is called and drawn, where its card is, and what a tick of it costs."""
    look = style.look(name)
    return {
        "name": families.word(name),
        "title": laws.title(name),
        "card": f"{families.CARDS}#{families.anchor(name)}",
        "colour": [look.colour, look.dark],
        "cost": cost(name, costs),
    }


def cost(name: str, costs: pd.DataFrame) -> str:
    """Operations a tick in words, where they differ also the worst branch."""
    totals = costs[(costs["contender"] == name) & (costs["stage"] == "total")].set_index("branch")
    if totals.empty:
        return html.MISSING
    said = {}
    for branch in ("typical", "worst"):
        calls = int(totals.loc[branch, list(CALLS)].sum())
        said[branch] = f"{int(totals.at[branch, 'flops'])} flops, {calls} {'call' if calls == 1 else 'calls'}"
    return said["typical"] if said["typical"] == said["worst"] else f"{said['typical']}; at most {said['worst']}"


def curve(own: pd.DataFrame, goal: Turn) -> dict:
    """One episode: its numbers, where it settles, and what became of it in words."""
    matrices = own[[f"{c}_{x}" for x in "xyz" for c in "noa"]].to_numpy().reshape(-1, 3, 3)
    is_rotation = np.abs(matrices).max(axis=(1, 2)) < NO_ROTATION
    own, turns = own[is_rotation], Turn.from_matrix(matrices[is_rotation])
    end = own.iloc[0]
    settling_s = float(end["settling_time_s"])
    command = np.minimum(np.linalg.norm(own[["u_x", "u_y", "u_z"]], axis=1), RULES.command_limit)
    return {
        "angle": whole(own["angle_rad"], ANGLE_UNIT),
        "command": whole(command, COMMAND_UNIT),
        "turn": whole((turns * goal.inv()).as_rotvec().ravel(), TURN_UNIT),
        "settling_s": None if math.isnan(settling_s) else settling_s,
        "ending": ending(end),
        "turned": turned(turns) if end["outcome"] == "settled" else html.MISSING,
        "peak": peak(command),
    }


def whole(values, unit: float) -> list[int | None]:
    """The values in whole units; None for what is no number."""
    return [None if math.isnan(value) else round(value / unit) for value in map(float, values)]


def ending(end: pd.Series) -> str:
    """What became of an episode, as the end of a sentence about its law."""
    away = degrees(end["final_angle_rad"])
    when = f"at {end['failure_time_s']:.2f}{NO_BREAK}s"
    return {
        "settled": f"settles in {end['settling_time_s']:.2f}{NO_BREAK}s",
        "stuck": f"is stuck {away} from the goal",
        "creeping": f"creeps, {away} from the goal at the end",
        "oscillating": f"oscillates, {away} from the goal at the end",
        "timed-out": f"does not settle and ends {away} from the goal",
        "diverged": f"diverges {when}",
        "singular": f"is singular {when} and has no command",
        "saturated": f"asks for more than {html.number(RULES.command_limit)}{NO_BREAK}rad/s² {when}",
        "crashed": f"crashes {when}",
        "hung": "never returns a command",
    }[end["outcome"]]


def turned(turns: Turn) -> str:
    """The way of the body from sample to sample."""
    return f"{math.degrees((turns[1:] * turns[:-1].inv()).magnitude().sum()):.0f}°"


def peak(command: np.ndarray) -> str:
    """The greatest command of the samples."""
    greatest = float(np.nanmax(command, initial=0.0))
    if not greatest:
        return html.MISSING if np.isnan(command).all() else "0"
    said = f"{html.number(float(f'{greatest:.3g}'))}{NO_BREAK}rad/s²"
    return f"over {said}" if greatest >= RULES.command_limit else said


def degrees(angle_rad: float) -> str:
    """An angle in degrees, with as many decimals as tell it from half a turn."""
    angle = math.degrees(angle_rad)
    short = abs(180.0 - angle)
    decimals = max(0, math.ceil(-math.log10(short))) if short > 1e-9 else 0
    return f"{angle:.{decimals}f}°"

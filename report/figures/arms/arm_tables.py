"""What there is on arms, as tables: the arms, their start sets, Jacobians, inverses."""

from __future__ import annotations

import functools
import sys

import mujoco
import numpy as np
import pandas as pd
from scipy.optimize import minimize

import tasks
from bench.contenders.registry import known_inverses, known_jacobians
from bench.law.resolved_motion import Inverse, Jacobian
from report.figures.arms import arm_rows
from report.figures.kit import html
from report.figures.kit.spelling import prose
from tasks.arm_model import Arm, model_xml
from tasks.kinematics import kinematics
from tasks.paths import zyx_angles

TRIED, POLISHED, SEED = 400, 4, 0
"""Random postures for the furthest one, and from how many of them it is climbed to."""


def arms() -> html.Markdown:
    """An arm a row: joints, reach, its Jacobian's condition number and the tool's beta at home, torques."""
    rows = []
    for name in tasks.arm_names():
        one = tasks.arm(name)
        model = kinematics(one)
        _, quat = model.pose(one.home)
        rated = ", ".join(f"{torque:g}" for torque in one.rated)
        rows.append(
            {
                "Arm": html.together(f"`{name}`"),
                "Maker's name": prose(one.title),
                "Joints": one.joints,
                "Reach [m]": reach(name),
                "Condition": model.condition(one.home),
                "β [deg]": round(float(np.degrees(zyx_angles(quat)[1]))) + 0,
                "Rated torques [N m]": rated,
            }
        )
    return html.table(pd.DataFrame(rows), {"Reach [m]": ".2f", "Condition": ".1f"})


def sources() -> html.Markdown:
    """An arm a line: where its numbers are from."""
    named = {name: tasks.arm(name).source for name in tasks.arm_names()}
    return html.Markdown("\n".join(f"- `{name}`: {prose(source)}" for name, source in named.items()))


@functools.cache
def reach(name: str) -> float:
    """Furthest distance of the tool from the second joint's anchor, joints within their ranges [m]."""
    one = tasks.arm(name)
    model = mujoco.MjModel.from_xml_string(model_xml(one, 1e-3))
    data = mujoco.MjData(model)
    site = model.site("tool").id

    def near(q) -> float:
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        return -float(np.linalg.norm(data.site_xpos[site] - data.xanchor[1]))

    low, high = ranges(one)
    tried = np.random.default_rng(SEED).uniform(low, high, size=(TRIED, one.joints))
    best = sorted(tried, key=near)[:POLISHED]
    bounds = list(zip(low, high, strict=True))
    return -min(minimize(near, q, method="L-BFGS-B", bounds=bounds).fun for q in best)


def ranges(one: Arm) -> tuple[np.ndarray, np.ndarray]:
    """Joint ranges [rad], one turn where there is none."""
    return np.clip(one.lower, -np.pi, None), np.clip(one.upper, None, np.pi)


def start_sets(rows: pd.DataFrame) -> html.Markdown:
    """A set a row: what its module says of it first, its starts on each arm of the run, its horizon."""
    lines = []
    for name in arm_rows.SETS:
        mine = rows[rows["start_set"] == name]
        tasks.start_set_title(name, arm=True)  # reads the module
        counts = mine.groupby("arm")["start_id"].nunique()
        starts = f"{counts.min()}" if counts.nunique() == 1 else f"{counts.min()} to {counts.max()}"
        lines.append(
            {
                "Set": html.together(f"`{name}`"),
                "What it is for": prose(first_paragraph(f"tasks.arm_starts.{name.replace('-', '_')}")),
                "Starts an arm": starts if len(counts) else "none",
                "Horizon [s]": float(mine["horizon_s"].max()) if len(mine) else None,
            }
        )
    return html.table(pd.DataFrame(lines))


def first_paragraph(module: str) -> str:
    """The summary of a module's docstring."""
    return " ".join((sys.modules[module].__doc__ or "").partition("\n\n")[0].split())


def jacobians() -> html.Markdown:
    """Every Jacobian: title and word, formula, the controller that uses it, source."""
    rows = [
        {
            "Jacobian": named(one),
            "Formula": in_lines(one.formula),
            "For": "(2.2)" if one.takes == "angular-acceleration" else "(3.7)",
            "Source": prose(one.source),
        }
        for one in known_jacobians().values()
    ]
    return html.table(pd.DataFrame(rows))


def inverses() -> html.Markdown:
    """Every inverse: title and word, formula, source."""
    rows = [
        {
            "Inverse": named(one),
            "Formula": in_lines(one.formula),
            "Source": prose(one.source),
        }
        for one in known_inverses().values()
    ]
    return html.table(pd.DataFrame(rows))


def named(one: Jacobian | Inverse) -> str:
    """Its title, and below it its word on the command line."""
    return f"{one.title}<br>{html.together(f'`{one.name}`')}"


def in_lines(formula: str) -> str:
    """A formula, each of its equations on a line."""
    return "<br>".join(f"${equation}$" for equation in formula.split(r", \quad "))

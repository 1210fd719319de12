"""The Euler Jacobian on arms: how it is conditioned, what it does past gimbal lock, and what it costs to compute."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple
from xml.etree import ElementTree

import pandas as pd

import tasks
from bench.experiments.tables.run import Run
from bench.findings.claims.adequacy import tallied
from bench.findings.claims.controller_costs import BY_EULER, INVERSES, ON_MATRIX, controller_costs
from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.findings.replication import compare_jacobians, pair_past_poles
from bench.law.contenders.registry import papers_coordinates
from report.figures.arms.arm_rows import name_arm
from report.figures.kit import html, media
from report.figures.kit.page import in_run
from report.figures.kit.quotes import quote
from report.figures.kit.spelling import power

PAPERS = papers_coordinates().name
LOST = 1e12
"""A condition number beyond which the rest is rounding: what a double holds, less four digits."""
BAD = 100.0
"""Condition number (metres, radians) from which on a Jacobian is called bad: twice what the claims allow."""
HAMMERED = 10.0
"""Peak torque over that of the law on R from the same start, as in claim C20: beyond it something hammers the arm."""
POLE = html.PageTable(
    "Arm | Moves | Moves that settle with the geometric Jacobian | Peak torque / rated torque, "
    "geometric Jacobian | Moves that settle with the Euler Jacobian | Peak torque / rated torque, "
    "Euler Jacobian"
)
QUOTED = {"adds": "C18", "fails": "C20", "dearer": "C26"}
"""Key of a sentence of the paper on the page -> its claim."""
FIRST_EXAMPLE = {"representation": PAPERS, "pose_set": "named", "arm": "puma560", "pose_id": "qn"}
FILM = (
    "The same motion with two controllers, side by side: the Euler Jacobian throws the arm about, "
    "and the geometric Jacobian turns the tool in place."
)


def facts(run: Run) -> dict[str, Any]:
    """Return the paper's words, the first example, the poses that J_E spoils, the film, the pole, and the cost."""
    return {
        **{f"quote_{key}": quote(claim) for key, claim in QUOTED.items()},
        "first": in_run(lambda: describe_first(run.rows("poses", **FIRST_EXAMPLE))),
        "spoilt": in_run(lambda: count_spoilt(run.rows("poses", representation=PAPERS, pose_set="random"))),
        "pole-loop": media.loop(FILM),
        **describe_film(),
        **(in_run(lambda: count_at_pole(pair_past_poles(run))) or {}),
        **(in_run(compare_torque, run) or {}),
        "operations": in_run(lambda: describe_operations(run)),
    }


def compare_torque(run: Run) -> dict[str, str]:
    """Return how much more torque the Euler Jacobian needs in the median move, with its 95 % interval."""
    harder = compare_jacobians(run).harder
    value, low, high = (html.number(float(f"{ratio:.2g}")) for ratio in harder)
    return {"harder": value, "harder_interval": f"{low} to {high}"}


def count_at_pole(both: pd.DataFrame) -> dict:
    """Return how many starts fail, and how much more torque the Euler Jacobian needs; and a row an arm."""
    fails, fails_euler = both["outcome"] != "settled", both["outcome_euler"] != "settled"
    hammered = ~fails_euler & (both["harder"] > HAMMERED)
    return {
        "pole": POLE(compare_at_pole(both)),
        "pole_n": len(both),
        "pole_fails": int(fails_euler.sum()),
        "pole_fails_m": int(fails.sum()) or "none",
        "hammer": f"{HAMMERED:g}",
        "hammered": int(hammered.sum()),
        "weak": describe_weak_motors(both),
    }


def compare_at_pole(both: pd.DataFrame) -> Iterator[tuple]:
    """Return a row an arm."""
    for arm, own in both.groupby("arm"):
        cells = []
        for end in ("", "_euler"):
            torque = float(f"{own[f'peak_torque_ratio{end}'].median():.2g}")
            cells += [count_words(int((own[f"outcome{end}"] == "settled").sum()), len(own)), torque]
        yield name_arm(arm), len(own), *cells


class Motor(NamedTuple):
    """The joint of an arm that an orientation error asks most of, beside what its motor can do.

    Attributes:
        inertia: Inertia of the motor, reflected to the joint [kg m^2].
        rated: Rated torque [N m].
    """

    inertia: float
    rated: float

    def torque(self, kp: float) -> float:
        """Return the torque that accelerates the motor alone at an error of 1 rad [N m]."""
        return kp * self.inertia


def find_weakest_motor(arm_name: str) -> Motor:
    """Return the motor with the greatest inertia for its rated torque; inertia 0 where the file states none."""
    arm = tasks.arm(arm_name)
    joints = [joint for joint in ElementTree.fromstring(arm.xml).iter("joint") if "name" in joint.attrib]
    inertias = [float(joint.get("armature", "0")) for joint in joints]
    motors = [Motor(inertia, float(rated)) for inertia, rated in zip(inertias, arm.rated, strict=False)]
    return max(motors, key=lambda motor: motor.inertia / motor.rated)


def describe_weak_motors(both: pd.DataFrame) -> str:
    """Explain the arms that exceed their rated torque with the geometric Jacobian, too."""
    sentences = []
    for arm, rows in both.groupby("arm"):
        ratio, kp = float(rows["peak_torque_ratio"].median()), float(rows["kp"].iloc[0])
        motor = find_weakest_motor(str(arm))
        if ratio <= 1.0 or not motor.inertia:
            continue
        torque = motor.torque(kp)
        sentences.append(
            f"The {name_arm(str(arm))} needs {ratio:.2g} times its rated torque even without "
            f"Euler angles. The model of this arm has a motor inertia of {motor.inertia:g} kg m² "
            f"at a joint whose motor is rated at {motor.rated:g} N m. With Kp = {kp:g}/s² and an "
            f"error of 1 rad, this motor needs {torque:g} N m, {torque / motor.rated:.0f} times "
            "the rated torque. The gains are too high for this arm, with either Jacobian."
        )
    none = "With the geometric Jacobian, no arm needs more than its rated torque in the median move."
    return " ".join(sentences) or none


def describe_operations(run: Run) -> str:
    """Say how many operations a control step takes with either Jacobian."""
    sentences = []
    for joints in INVERSES:
        geometric, euler = (
            tallied(controller_costs(run, name, joints), with_goal=True) for name in (ON_MATRIX, BY_EULER)
        )
        more = euler.flops / geometric.flops - 1.0
        sentences.append(
            f"On an arm with {joints} joints, a control step takes {html.number(geometric.flops)} "
            "operations with the geometric Jacobian and the rotation-matrix law. With the Euler "
            "Jacobian and the feedback-linearized law, a control step takes "
            f"{html.number(euler.flops)} operations ({100 * more:+.0f} %) and {euler.calls} calls "
            "of sine, cosine and arctangent."
        )
    return " ".join(sentences)


def count_words(part: int, whole: int) -> str:
    """Write how many of some moves: all, none, or a count of the whole."""
    if part == whole:
        return f"all {whole}"
    return f"{part} of {whole}" if part else "none"


def describe_first(rows: pd.DataFrame) -> str:
    """Return both condition numbers and the pitch of a pose in words."""
    at = rows.iloc[0]
    of_angles = float(at["condition_analytic"])
    number = html.MISSING if math.isnan(of_angles) else power(of_angles) if of_angles > LOST else f"{of_angles:.1f}"
    return (
        f"the geometric Jacobian has the condition number {at['condition']:.1f}. The Euler "
        f"Jacobian has the condition number {number}, because the tool is at β = "
        f"{math.degrees(at['beta']):.0f}°"
    )


def count_spoilt(rows: pd.DataFrame) -> str:
    """Return the least and greatest share of poses with a good J that J_E of Z-Y-X angles makes bad, in words."""
    fine = rows[rows["condition"] <= WELL_CONDITIONED]
    by = 100.0 * (fine["condition_analytic"] > BAD).groupby(fine["arm"].astype(str)).mean()
    return (
        "We took random poses where the geometric Jacobian has a condition number of at most "
        f"{WELL_CONDITIONED:g}. In {by.min():.1f} to {by.max():.1f} % of these poses, depending "
        f"on the arm, the Euler Jacobian has a condition number above {BAD:g}."
    )


def describe_film() -> dict[str, str]:
    """Return the arm of the film, how much torque both controllers ask for, and how long a way one goes."""
    about = media.facts()
    euler, geometric = about["episodes"]
    return {
        "film_arm": name_arm(about["arm"]),
        "film_ratio": f"{euler['peak_torque_ratio']:.0f}",
        "film_ratio_geometric": f"{geometric['peak_torque_ratio']:.2f}",
        "film_path": f"{euler['path_ratio']:.1f}",
    }

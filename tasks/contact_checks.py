"""Refuse what no episode in contact can begin with.

A specification may hold nothing (the hand is led by hand) or everything (nothing complies): unusual, but meaningful.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tasks.arm_model import Arm
from tasks.contact import AXES, MOST_LEGS, Specification, Trial
from tasks.contact_model import ContactModel
from tasks.episode import UNIT_NORM_TOLERANCE
from tasks.errors import BadValue


def check_specification(specification: Specification) -> None:
    """BadValue if a specification is none."""
    what = f"specification '{specification.name}'"
    if np.shape(specification.selection) != (6,) or any(one not in (0, 1) for one in specification.selection):
        raise BadValue(
            f"{what}: selection = {_on_one_line(specification.selection)} must be six of 0 and 1, for "
            f"{', '.join(AXES)} (the diagonal of the selection matrix: 1 is held, 0 complies)"
        )
    _check_numbers(f"{what}: desired_wrench", specification.desired_wrench, 6, "N, N m")
    _check_numbers(f"{what}: velocity", specification.velocity, 3, "m/s")
    for axis, held, exerted in zip(AXES, specification.selection, specification.desired_wrench, strict=True):
        if held and exerted:
            raise BadValue(f"{what}: {axis} is held and is to exert {exerted:g} at once (release it or exert 0)")


def check_trial(trial: Trial, arm: Arm) -> None:
    """BadValue if no episode of this arm can be made of a trial."""
    if not isinstance(trial, Trial):
        raise BadValue(f"{trial} is no trial of a task in contact (try: tasks.contact_task(name).trials(arm))")
    check_specification(trial.specification)
    what = f"trial '{trial.id}'"
    _check_numbers(f"{what}: q", trial.q, arm.joints, "rad", f", one for each joint of arm '{arm.name}'")
    for i, (angle, lower, upper) in enumerate(zip(trial.q, arm.lower, arm.upper, strict=True)):
        if not lower <= angle <= upper:
            raise BadValue(
                f"{what}: q has joint {i + 1} of arm '{arm.name}' at {angle:g} rad, outside {lower:g} to {upper:g} "
                "(is it a trial of another arm?)"
            )
    for field in ("goal_wxyz", "mount_wxyz", "scene_wxyz"):
        quat = getattr(trial, field)
        if np.shape(quat) != (4,) or not abs(math.hypot(*quat) - 1.0) <= UNIT_NORM_TOLERANCE:
            raise BadValue(f"{what}: {field} = {quat} is no unit quaternion wxyz (divide it by its norm)")
    _check_numbers(f"{what}: scene_pos", trial.scene_pos, 3, "m")
    if any(trial.push) and trial.legs:
        raise BadValue(f"{what}: it has a push and legs, which take its place (leave one of them away)")
    if len(trial.pushes) > MOST_LEGS:
        raise BadValue(f"{what}: {len(trial.pushes)} legs, and {MOST_LEGS} are the most (leave some away)")
    for push in trial.pushes:
        _check_numbers(f"{what}: a push", push, 6, "N, N m")


def check_contact(contact: ContactModel) -> None:
    """BadValue for numbers that MuJoCo would replace by its defaults without a word."""
    for name, value in contact._asdict().items():
        least, most = (0.0, 1.0) if name in ("dmin", "dmax") else (0.0, math.inf)
        if not (least < value < most or (name in ("friction", "noslip") and value == 0)):
            bounds = "between 0 and 1" if most == 1.0 else "finite and above 0"
            raise BadValue(f"contact model: {name} = {value} must be {bounds} (try: {getattr(ContactModel(), name)})")


def _check_numbers(what: str, given: Any, count: int, unit: str, of: str = "") -> None:
    if not _are_finite(given, count):
        raise BadValue(f"{what} = {_on_one_line(given)} must be {count} finite numbers [{unit}]{of}")


def _are_finite(given: Any, count: int) -> bool:
    """Tell whether something is so many finite numbers."""
    if isinstance(given, tuple) and len(given) == count and all(isinstance(number, float) for number in given):
        # numpy says the same, and takes ten times as long
        return all(map(math.isfinite, given))
    return np.shape(given) == (count,) and bool(np.isfinite(given).all())


def _on_one_line(given: Any) -> str:
    return " ".join(str(given).split())

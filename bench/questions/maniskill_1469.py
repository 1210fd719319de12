"""A rotation scaled by its lower bound turns the other way."""

import numpy as np

from bench.questions.question import Curves, Question

LOW, HIGH = -0.1, 0.1


def closed_loop(scale: float, error: float) -> float:
    """The error that is left after 20 steps, each an action of the error clipped to 1 and scaled [rad]."""
    for _ in range(20):
        error -= scale * np.clip(error, -1.0, 1.0)
    return abs(error)


def curves() -> Curves:
    """What a loop leaves of an error of so many radians, over the error."""
    errors = np.linspace(0.05, 1.0, 40)
    before, after = (np.array([closed_loop(scale, error) / error for error in errors]) for scale in (LOW, HIGH))
    return Curves(errors, before, after)


QUESTION = Question(
    "maniskill-1469",
    "A positive rotation turns backwards",
    ("mani-skill/ManiSkill#1469", "mani-skill/ManiSkill#1472", "mani-skill/ManiSkill#1435"),
    "Rotation actions of a pose controller turn the wrong way and closed loops diverge; translation is right. "
    "Failed inverse kinematics make it look like a frozen arm.",
    "The action, between −1 and 1, is multiplied by the lower bound, which is negative.",
    "Multiply by the upper bound.",
    "error at the start [rad]",
    "error after 20 steps over the error at the start",
    curves,
    tolerance=0.2,
)

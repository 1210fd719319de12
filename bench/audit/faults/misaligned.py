"""the error is not along the axis of the rotation.

effect: the robot takes a detour, or does not reach the goal
cure: compute the rotation R_d R^T or q_d q*, and use the axis of this rotation
unless: quaternion-order, transpose, frame, euler-angles, raises, not-a-number, axis-clip, long-way, deadband, memory
"""

import itertools
from collections.abc import Iterator

import numpy as np

from bench.audit.convention import FORMS, directions
from bench.audit.examined import FAULT, Examined, Model, Symptom, explanation
from bench.audit.pairs import Pairs, Place
from bench.audit.rotations import rotated

BENT_RAD = 1e-3
"""Angle to the axis: half a thousandth of it is what single precision leaves nowhere in these places."""
COARSE = 30.0
"""Times what most answers are off the axis: half precision leaves less than that."""
EXACT, NEARLY = 1e-6, 0.05
"""What a constant matrix may leave everywhere, or near the goal, as a share of the largest answer."""


def find(examined: Examined) -> Symptom | None:
    """Away from 0 and 180° answers leave the axis."""
    here = np.flatnonzero(examined.at("wide", "close"))
    angle = np.nan_to_num(np.fmin(examined.apart, np.pi - examined.apart)[here])  # against the axis is another fault
    bent = angle > (max(BENT_RAD, COARSE * examined.noise) if examined.noise < BENT_RAD else BENT_RAD)
    worst = int(np.argmax(angle))
    evidence = examined.evidence(int(here[worst]))
    if examined.convention and not bent.any():
        return None
    if not examined.form and (matrix := find_matrix(examined)):
        effect = "the robot turns about another axis than the shortest way has, away from the goal if a sign is wrong"
        cure = "leave the matrix out of the error; gains that differ belong behind it, and their frame to the gains"
        return Symptom(matrix, evidence, FAULT, effect, cure)
    if not examined.convention:
        said = explanation(examined, differences, "e is the difference of {}: no axis of the rotation from R to R_d")
        return said or Symptom(
            "nothing known explains its answers: they lie along no axis", evidence
        )
    where = np.degrees(examined.pairs.angle[here][bent])
    text = f"{bent.sum()} of {len(here)} answers, at {where.min():.3g}° to {where.max():.3g}°, are off the axis"
    return Symptom(f"{text} by up to {np.degrees(angle[worst]):.3g}°", evidence)


def find_matrix(examined: Examined) -> str:
    """Return the constant M by which e differs from a form, or near the goal, in words; empty if there is none."""
    places: dict[Place, tuple[float, str]] = {"wide": (EXACT, ""), "fine": (NEARLY, "near the goal ")}
    for place, (tolerance, near) in places.items():
        of = examined.pairs.chosen(examined.at(place))
        e, body = examined.e[examined.at(place)], directions(of, "body")
        e_body = rotated(of.R.swapaxes(1, 2), e)
        for words, left, k in (("M", e, of.axis), ("M R^T", e, body), ("R M R^T", e_body, body)):
            for form in FORMS.values():
                right = form.size(of.angle)[:, None] * k
                M = np.linalg.pinv(right) @ left if np.isfinite(left).all() else np.zeros((3, 3))
                M = np.where(np.abs(M) < tolerance * np.abs(M).max(), 0.0, M).T
                fits = np.abs(right @ M.T - left).max() <= tolerance * np.abs(left).max()
                if fits and np.abs(M - M[0, 0] * np.eye(3)).max() > 2.0 * tolerance * np.abs(M).max():
                    rows = [[float(f"{one:.{2 if near else 4}g}") for one in row] for row in (np.diag(M), *M)]
                    M_text = f"diag({rows[0]})" if np.array_equal(np.diag(np.diag(M)), M) else f"{rows[1:]}"
                    return f"{near}e = {words} {form.title} k with M = {M_text}"
    return ""


def differences(pairs: Pairs) -> Iterator[Model]:
    """Yield differences of what two orientations have from the base frame, of each form; w >= 0, or as it is."""
    for is_near, (name, form) in itertools.product((True, False), FORMS.items()):
        both = []
        for q in (pairs.q, pairs.q_d):
            near = np.where(is_near & (q[:, :1] < 0.0), -q, q)
            length = np.linalg.norm(near[:, 1:], axis=1)
            both.append((form.size(2.0 * np.arctan2(length, near[:, 0])) / length)[:, None] * near[:, 1:])
        yield f"two errors from the base frame, each {form.title} k ({name})", both[1] - both[0]

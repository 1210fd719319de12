"""C28: what the integral of angular velocity says of an orientation (Murphy 1988, 2 and 2.1)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import claim, word_of

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation as Turn

WAYS, LEGS = 200, 5
"""Pairs of ways with the same ends; turns about one axis, one after the other."""

APART_RAD, SAME_RAD = 1e-3, 1e-12
"""Two integrals that are not the same; two orientations that are, to rounding."""

LOOPS_RAD = (0.1, 0.5, 1.0, math.pi / 2)
COMMUTATOR = 0.5
"""Of angle^2, by which four quarter-way turns about x, y, -x, -y must at least miss: by Campbell, Baker and Hausdorff
they miss by angle^2 about z, less terms of third order."""


@claim(
    id="C28",
    section="2, 2.1",
    quote="""
        However, in rotation, it is not meaningful to integrate the angular velocities (Goldstein 1980). The exception
        is when rotation occurs in a plane, whereupon the rotational angle is equivalent to the integral of the angular
        velocity.
    """,
    correction="The exception of a plane is none.",
    written="2026-11-23 bc126c2",
    sentence="The integral of angular velocity has no meaning as an orientation, but in a plane.",
    question="Do ways with the same ends have the same integral, and do those about one axis?",
    criterion=f"""
        Ways of turns at constant angular velocity, whose integral is axis times angle. (a) The integral is no function
        of the orientation: {WAYS} random orientations, each reached straight and by way of another random one, the two
        integrals at least {APART_RAD:g} rad apart for every one. (b) The orientation is none of the integral: turns by
        an angle a about x, y, -x and -y, whose integrals sum to zero, leave the body turned by at least {COMMUTATOR:g}
        a^2, for a = 0.1, 0.5, 1 and pi/2. (c) The exception: {LEGS} turns by random angles about one axis, {WAYS} axes,
        end where one turn by the integral ends, to {SAME_RAD:g} rad. It holds if all three pass; with a correction if
        (a) and (b) do; otherwise it does not hold.
    """,
    open="Base frame, as (2.3) has it; in the body's the same turns the other way round.",
)
def c28(results):
    """Ways with the same ends, a loop of zero integral, and turns about one axis."""
    ends, loops, plane = results.found_by(ways, results.seed)
    is_none = ends.min() >= APART_RAD and all(
        missed >= COMMUTATOR * a * a for a, missed in zip(LOOPS_RAD, loops, strict=True)
    )
    word = word_of(is_none and plane <= SAME_RAD, is_none)
    missed = ", ".join(f"{angle:.3f} (a = {a:.3g})" for a, angle in zip(LOOPS_RAD, loops, strict=True))
    return word, evidence(
        f"""Of {len(ends)} pairs of ways with the same ends the integrals differ by {ends.min():.2f} to {ends.max():.2f}
        rad, {np.median(ends):.2f} in the median. After turns whose integrals sum to zero the body is turned by {missed}
        rad. About one axis the integral is the turn to {plane:.0e} rad.""",
        2 * len(ends) + len(loops),
        ("experiment",),
    )


def ways(seed: int) -> tuple[np.ndarray, list[float], float]:
    """Distances of the integrals of two ways with the same ends, what loops of zero integral leave, what a plane does.

    Oracle: scipy's rotations.
    """
    from scipy.spatial.transform import Rotation as Turn

    rng = np.random.default_rng(seed)
    end, between = Turn.random(WAYS, rng=rng), Turn.random(WAYS, rng=rng)
    by_way = between.as_rotvec() + (end * between.inv()).as_rotvec()
    ends = np.linalg.norm(end.as_rotvec() - by_way, axis=1)
    x, y = np.eye(3)[:2]
    loops = [float(_after([a * x, a * y, -a * x, -a * y]).magnitude()) for a in LOOPS_RAD]
    axes = rng.normal(size=(WAYS, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    turns = [angles[:, None] * axis for axis, angles in zip(axes, rng.uniform(-3, 3, (WAYS, LEGS)), strict=True)]
    plane = max(float((Turn.from_rotvec(legs.sum(axis=0)).inv() * _after(legs)).magnitude()) for legs in turns)
    return ends, loops, plane


def _after(legs) -> Turn:
    """Where turns in the base frame end, one after the other."""
    from scipy.spatial.transform import Rotation as Turn

    at = Turn.identity()
    for leg in legs:
        at = Turn.from_rotvec(leg) * at
    return at

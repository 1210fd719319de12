"""A law as a field u(R, omega), a row a finding, with the state that shows it; all laws have the same rows.

Stiffness and damping are shares of the gains that are set, and so are commands: |u|/kp.

Fails: a dead point off the half turns that no search runs into, and a jump that no geodesic crosses, are not seen.
"""

from collections.abc import Iterator

import numpy as np

from bench.experiments.rows.command_field.dead_points import dead_points
from bench.experiments.rows.command_field.field import Field, Finding
from bench.experiments.rows.command_field.geodesics import along_geodesics
from bench.experiments.rows.command_field.near_goal import near_goal, rest
from bench.law.contender import Contender, Gains


def findings(one: Contender, gains: Gains, seed: int) -> Iterator[Finding]:
    """All that is found of a law."""
    field = Field(one, gains)
    with np.errstate(all="ignore"):
        yield from near_goal(field)
        yield from dead_points(field, seed)
        yield from along_geodesics(field)
        yield rest(field, seed)

"""The floor of settling at any start of the map, between the nodes of a table: results/floor.

In units of 1/sqrt(a), a the bound of the acceleration, the least settling time depends on three numbers: the first
angle theta, the speed w = |omega|/sqrt(a), and the cosine of the angle between omega and the axis of the turn from the
goal to the body (-1: it turns to the goal, 1: away). The table has other coordinates, in which the time over sqrt(e) is
smooth down to theta = 0 and w = 0:

    e = theta + w^2/2        beta = arccos(sqrt(theta/min(e, pi)))

Near e = 0 space is flat, and there the time over sqrt(e) depends on beta and the cosine alone: below the first node
of e it is that of the first node. Between nodes it is linear in all three.
"""

import functools
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from bench.findings.theory.time_optimal import certain_least_time
from tasks.rules import RULES

STUDY = RESULTS / "floor"
"""What `python -P -m bench.studies.floor` keeps."""

TABLE = "floor"
AXES = ("root_energy", "mixture", "cosine")


class ReducedStart(NamedTuple):
    """Starts, in units of 1/sqrt(a); numbers, or arrays of one shape.

    Attributes:
        angle: To the goal, theta [rad].
        speed: |omega|/sqrt(a).
        cosine: Of the angle between omega and the axis of the turn from the goal to the body.
    """

    angle: np.ndarray
    speed: np.ndarray
    cosine: np.ndarray


class Floor(NamedTuple):
    """The least settling time of each start.

    Attributes:
        times: The shortest known [s].
        certain: A proved lower bound of it [s].
        is_known: Whether the start lies in the table; elsewhere `times` is `certain`.
    """

    times: np.ndarray
    certain: np.ndarray
    is_known: np.ndarray


class Grid(NamedTuple):
    """The table: the nodes of each of AXES, and the time over sqrt(e) at each node."""

    axes: tuple[np.ndarray, ...]
    ratios: np.ndarray


def find_coordinates(start: ReducedStart) -> np.ndarray:
    """Return the coordinates of starts as the table has them, a row each of AXES."""
    energy = start.angle + 0.5 * start.speed**2
    share = np.divide(start.angle, np.minimum(energy, np.pi), out=np.ones_like(energy), where=energy > 0.0)
    mixture = np.arccos(np.sqrt(np.minimum(share, 1.0)))
    return np.stack([np.sqrt(energy), mixture, start.cosine])


def find_start(root_energy: np.ndarray, mixture: np.ndarray, cosine: np.ndarray) -> ReducedStart:
    """Return the starts at coordinates of the table."""
    energy = root_energy**2
    angle = np.minimum(energy, np.pi) * np.cos(mixture) ** 2
    speed = np.sqrt(2.0 * (energy - angle))
    return ReducedStart(angle, speed, cosine)


def measure_starts(quats_wxyz: np.ndarray, omegas: np.ndarray, acceleration: float) -> ReducedStart:
    """Return the three numbers of starts.

    Args:
        quats_wxyz: the turn from the goal to the body; shape (n, 4).
        omegas: angular velocity [rad/s], base frame; shape (n, 3).
        acceleration: bound of |u| [rad/s^2].
    """
    vectors = quats_wxyz[:, 1:]
    sines = np.linalg.norm(vectors, axis=1)
    scalars = quats_wxyz[:, 0]
    angle = 2.0 * np.arctan2(sines, np.abs(scalars))
    speed = np.linalg.norm(omegas, axis=1)
    along = np.sum(vectors * omegas, axis=1) * np.where(scalars < 0.0, -1.0, 1.0)
    product = sines * speed
    # At rest, or at the goal, there is no angle between two directions, and none is needed.
    cosine = np.divide(along, product, out=np.zeros_like(along), where=product > 0.0)
    return ReducedStart(angle, speed / np.sqrt(acceleration), cosine)


@functools.cache
def read_grid(folder: Path = STUDY) -> Grid:
    """Return the table of the study."""
    return make_grid(read(folder, TABLE))


def make_grid(rows: pd.DataFrame) -> Grid:
    """Return the rows of the table as a grid; they must be those of every node."""
    ordered = rows.sort_values(list(AXES))
    axes = tuple(np.unique(rows[name].to_numpy()) for name in AXES)
    ratios = (ordered["time"] / ordered["root_energy"]).to_numpy()
    return Grid(axes, ratios.reshape([len(nodes) for nodes in axes]))


def interpolate(grid: Grid, coordinates: np.ndarray) -> np.ndarray:
    """Return the time over sqrt(e) between nodes, linear in each coordinate; the nearest beyond the last nodes."""
    places = []
    weights = []
    for nodes, values in zip(grid.axes, coordinates, strict=True):
        held = np.clip(values, nodes[0], nodes[-1])
        place = np.searchsorted(nodes[1:-1], held, side="right")
        width = nodes[place + 1] - nodes[place]
        places.append(place)
        weights.append((held - nodes[place]) / width)
    total = np.zeros_like(coordinates[0])
    for corner in np.ndindex(2, 2, 2):
        weight = np.ones_like(total)
        index = []
        for place, share, side in zip(places, weights, corner, strict=True):
            weight = weight * (share if side else 1.0 - share)
            index.append(place + side)
        total = total + weight * grid.ratios[tuple(index)]
    return total


def find_floor(
    quats_wxyz: np.ndarray,
    omegas: np.ndarray,
    acceleration: float,
    grid: Grid | None = None,
) -> Floor:
    """Return the floor of settling of each start; the arguments are those of `measure_starts`.

    Of the tests' 20 starts (speeds up to 4 sqrt(a)) 18 are within 1 % of what shooting finds at the start itself, and
    all within 5 %. The greatest errors are where two families of motions are equally fast, near 180 deg at low speed
    and for sqrt(e) from 0.8 to sqrt(pi), where nodes are 0.2 to 0.3 apart: there the table may be 5 % too short.

    Limitations: those of `time_optimal`. Angles below the last node of beta, 0.0081 rad where e > pi, have the ratio of
    that node; of uniform orientations one in 37 million is nearer.
    """
    grid = grid or read_grid()
    start = measure_starts(quats_wxyz, omegas, acceleration)
    is_away = start.angle >= RULES.at_goal_rad
    certain = np.where(is_away, certain_least_time(start.angle, start.speed, 1.0), 0.0)
    coordinates = find_coordinates(start)
    is_known = is_away & (coordinates[0] <= grid.axes[0][-1])
    known = np.maximum(interpolate(grid, coordinates) * coordinates[0], certain)
    times = np.where(is_known, known, certain)
    unit_s = 1.0 / np.sqrt(acceleration)
    return Floor(unit_s * times, unit_s * certain, is_known)

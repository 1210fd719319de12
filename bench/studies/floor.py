"""What is the least settling time with a bounded command? A table over all starts of the map: results/floor.

First to rest at the goal. Every fourth node of the grid along each axis is solved from drawn guesses. Then every node
is solved from what its neighbours have, for as long as any time becomes shorter: a family of extremals that is the
fastest in a region grows until another is faster. Then to the band: from the extremals to rest that a node and its
neighbours lead to, those that are the fastest or nearly so. Nodes at rest and nodes that spin about the axis of the
turn have closed forms, too, and the shorter is kept.
"""

import time
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.findings.floor import AXES, STUDY, TABLE, ReducedStart, find_start
from bench.findings.theory.extremals import (
    SOLVED,
    Bodies,
    draw_guesses,
    improve,
    miss_band,
    miss_rest,
)
from bench.findings.theory.time_optimal import (
    certain_least_time,
    least_time_about_axis,
    shorten,
)
from bench.studies.study import keep_table, make_parser
from tasks.rules import RULES

LOW = (0.2, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7)
"""Nodes of sqrt(e) below sqrt(pi): near zero the time over sqrt(e) does not depend on it. Above 0.8 other
motions become the shortest: with nodes 0.3 apart the table was up to 4 % too short there."""

HIGHEST, SPACING = 6.2, 0.11
"""The last node of sqrt(e), and the distance of nodes from sqrt(pi) on. At 180 deg the speed is 8.4 sqrt(a) there:
more than that of 19 in 20 situations of the map that have both a bound and a spin."""

MIXTURES, LAST_MIXTURE = 27, 1.52
COSINES = 23
"""Nodes of the cosine: -1 + 2 u^2, u from 0 to 1. Near -1, where the body spins to the goal, a small angle to the axis
costs the most time."""

SEEDS_APART = 4
"""Every so many nodes along each axis are solved from drawn guesses."""

GUESSES, SEED = 40, 20261201
SWEEPS, ROUNDS = 30, 12
"""Sweeps over the grid, at most; and steps of the solver from a neighbour's extremal."""

SHORTER = 1e-4
"""Relative amount by which a time must be shorter to replace another."""

NEARLY = 1.04
"""A time to rest over the shortest one, up to which the extremal may be the fastest to the band."""

CLOSED, EXTREMAL, REST = "closed form", "extremal", "extremal to rest"
BRAKING = "braking first"


class Nodes(NamedTuple):
    """The nodes of the grid as a list, and what is known of each.

    Attributes:
        shape: Number of nodes along each axis.
        coordinates: Of each node, a row each of AXES; shape (3, n).
        start: Angle, speed and cosine of each node.
        bodies: At each node.
        times: Shortest time to rest [1/sqrt(a)]; infinite where none is known.
        unknown: Extremals of these times; shape (7, n), of no meaning where there is none.
    """

    shape: tuple[int, ...]
    coordinates: np.ndarray
    start: ReducedStart
    bodies: Bodies
    times: np.ndarray
    unknown: np.ndarray


def make_axes() -> tuple[np.ndarray, ...]:
    """Return the nodes along each axis."""
    root_pi = np.sqrt(np.pi)
    count = round((HIGHEST - root_pi) / SPACING)
    high = root_pi + SPACING * np.arange(count + 1)
    root_energy = np.concatenate([LOW, high])
    mixture = np.linspace(0.0, LAST_MIXTURE, MIXTURES)
    cosine = 2.0 * np.linspace(0.0, 1.0, COSINES) ** 2 - 1.0
    return root_energy, mixture, cosine


def make_nodes(axes: tuple[np.ndarray, ...]) -> Nodes:
    """Return the nodes of a grid, nothing known of them."""
    mesh = np.meshgrid(*axes, indexing="ij")
    coordinates = np.stack([values.ravel() for values in mesh])
    start = find_start(*coordinates)
    count = coordinates.shape[1]
    return Nodes(
        shape=mesh[0].shape,
        coordinates=coordinates,
        start=start,
        bodies=place_bodies(start),
        times=np.full(count, np.inf),
        unknown=np.zeros((7, count)),
    )


def place_bodies(start: ReducedStart) -> Bodies:
    """Return bodies turned from the goal about z, with their spin in the plane of x and z."""
    half = 0.5 * start.angle
    zero = np.zeros_like(half)
    sine = np.sqrt(np.maximum(0.0, 1.0 - start.cosine**2))
    quat = np.stack([np.cos(half), zero, zero, np.sin(half)])
    omega = start.speed * np.stack([sine, zero, start.cosine])
    return Bodies(quat, omega, RULES.tolerance * start.angle)


def seed_nodes(nodes: Nodes) -> np.ndarray:
    """Solve every SEEDS_APART-th node along each axis from drawn guesses; return which changed."""
    numbers = np.arange(len(nodes.times)).reshape(nodes.shape)
    return draw_extremals(nodes, numbers[::SEEDS_APART, ::SEEDS_APART, ::SEEDS_APART].ravel())


def draw_extremals(nodes: Nodes, chosen: np.ndarray) -> np.ndarray:
    """Solve some nodes to rest from drawn guesses; return which nodes changed."""
    target = np.repeat(chosen, GUESSES)
    shortest = find_bounds(nodes)
    drawn = draw_guesses(shortest[target], np.random.default_rng(SEED))
    unknown, missing = improve(nodes.bodies.take(target), drawn, miss_rest)
    return keep_shorter(nodes, target, unknown, missing)


def find_bounds(nodes: Nodes) -> np.ndarray:
    """Return the proved lower bound of the time to rest of each node."""
    return np.asarray(certain_least_time(nodes.start.angle, nodes.start.speed, 1.0, 0.0))


def keep_shorter(
    nodes: Nodes, target: np.ndarray, unknown: np.ndarray, missing: np.ndarray
) -> np.ndarray:
    """Keep solved extremals of nodes that are shorter than what is known; return which nodes changed."""
    times = np.where(missing <= SOLVED, np.exp(unknown[6]), np.inf)
    # An extremal before the proved bound would be an error of the integration.
    certain = find_bounds(nodes)
    times[times < (1.0 - SHORTER) * certain[target]] = np.inf
    changed = np.zeros(len(nodes.times), dtype=bool)
    for entry in np.argsort(times):
        node = target[entry]
        if times[entry] < (1.0 - SHORTER) * nodes.times[node]:
            nodes.times[node] = times[entry]
            nodes.unknown[:, node] = unknown[:, entry]
            changed[node] = True
    return changed


def list_pairs(nodes: Nodes, is_new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return each node whose neighbour is new, and that neighbour; a pair an entry."""
    numbers = np.arange(len(nodes.times)).reshape(nodes.shape)
    targets, sources = [], []
    for axis in range(numbers.ndim):
        low = np.delete(numbers, -1, axis).ravel()
        high = np.delete(numbers, 0, axis).ravel()
        targets += [low, high]
        sources += [high, low]
    target, source = np.concatenate(targets), np.concatenate(sources)
    is_asked = is_new[source]
    return target[is_asked], source[is_asked]


def solve_pairs(
    nodes: Nodes, target: np.ndarray, source: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Solve nodes to rest from what others have; return unknowns, and what is missing."""
    guesses = nodes.unknown[:, source].copy()
    root_energy = nodes.coordinates[0]
    guesses[6] += np.log(root_energy[target] / root_energy[source])
    return improve(nodes.bodies.take(target), guesses, miss_rest, ROUNDS)


def sweep(nodes: Nodes, is_new: np.ndarray) -> np.ndarray:
    """Solve nodes from what their new neighbours have; return which nodes changed."""
    target, source = list_pairs(nodes, is_new)
    unknown, missing = solve_pairs(nodes, target, source)
    return keep_shorter(nodes, target, unknown, missing)


def list_candidates(nodes: Nodes) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes and extremals to rest, from which the fastest to the band are sought.

    An extremal of a node is listed once, however many neighbours lead to it.
    """
    known = np.isfinite(nodes.times)
    target, source = list_pairs(nodes, known)
    unknown, missing = solve_pairs(nodes, target, source)
    times = np.exp(unknown[6])
    is_near = (missing <= SOLVED) & (times <= NEARLY * nodes.times[target])
    owners = np.flatnonzero(known)
    target = np.concatenate([owners, target[is_near]])
    unknown = np.hstack([nodes.unknown[:, owners], unknown[:, is_near]])
    # Times that agree to three parts in a thousand are those of one extremal.
    rounded = np.round(unknown[6] / 0.003)
    _, chosen = np.unique(np.stack([target, rounded]), axis=1, return_index=True)
    return target[chosen], unknown[:, chosen]


def find_band_times(nodes: Nodes) -> np.ndarray:
    """Return the shortest time of an arrival in the band of each node; infinite where there is none."""
    target, at_rest = list_candidates(nodes)
    bodies = nodes.bodies.take(target)
    unknown, missing = improve(bodies, shorten(bodies, at_rest), miss_band)
    is_solved = missing <= SOLVED
    times = np.full(len(nodes.times), np.inf)
    np.minimum.at(times, target[is_solved], np.exp(unknown[6, is_solved]))
    return times


def list_closed_forms(nodes: Nodes) -> np.ndarray:
    """Return the time of the closed form of each node; infinite where there is none."""
    times = np.full(len(nodes.times), np.inf)
    is_about_axis = (np.abs(nodes.start.cosine) == 1.0) | (nodes.start.speed == 0.0)
    for node in np.flatnonzero(is_about_axis):
        angle, speed, cosine = (values[node] for values in nodes.start)
        times[node] = least_time_about_axis(angle, -speed * cosine, 1.0)
    return times


def list_braking_times(nodes: Nodes) -> np.ndarray:
    """Return the time of another motion of each node: to brake first, and then to turn from rest."""
    half = 0.25 * nodes.start.speed**2
    turned = nodes.bodies.quat
    # The turn by speed^2/2 about the spin comes after the first one: the scalar of the product.
    along = np.cos(half) * turned[0] - np.sin(half) * nodes.start.cosine * turned[3]
    angle = 2.0 * np.arccos(np.minimum(np.abs(along), 1.0))
    band = nodes.bodies.band
    from_rest = 2.0 * (np.sqrt(angle + band) - np.sqrt(band))
    return nodes.start.speed + from_rest


def make_rows(nodes: Nodes) -> pd.DataFrame:
    """Return the table: a row a node."""
    closed = list_closed_forms(nodes)
    arriving = find_band_times(nodes)
    # In for good at the latest at that time, as `least_settling_time` has it.
    from_rest = nodes.times - np.sqrt(2.0 * nodes.bodies.band)
    times = np.minimum(arriving, from_rest)
    method = np.where(arriving <= from_rest, EXTREMAL, REST)
    braking = list_braking_times(nodes)
    is_braking = braking < times
    times = np.where(is_braking, braking, times)
    method = np.where(is_braking, BRAKING, method)
    # A shooting is exact to 1e-4: a closed form as good as that is given.
    is_closed = closed <= (1.0 + SHORTER) * times
    columns = dict(zip(AXES, nodes.coordinates, strict=True))
    return pd.DataFrame(columns).assign(
        angle=nodes.start.angle,
        speed=nodes.start.speed,
        time=np.where(is_closed, closed, times),
        method=np.where(is_closed, CLOSED, method),
    )


def solve(nodes: Nodes) -> int:
    """Solve all nodes to rest; return the number of sweeps."""
    sweeps = spread(nodes, seed_nodes(nodes))
    is_left = np.isinf(nodes.times) & np.isinf(list_closed_forms(nodes))
    return sweeps + spread(nodes, draw_extremals(nodes, np.flatnonzero(is_left)))


def spread(nodes: Nodes, is_new: np.ndarray) -> int:
    """Solve neighbours of new nodes for as long as any node changes; return the number of sweeps."""
    for count in range(SWEEPS):
        if not is_new.any():
            return count
        spent = time.process_time()
        print(f"{spent:.0f} s of CPU: {is_new.sum()} nodes are new", flush=True)
        is_new = sweep(nodes, is_new)
    return SWEEPS


def main() -> None:
    """Run the study."""
    make_parser("floor", __doc__).parse_args()
    began = time.process_time()
    nodes = make_nodes(make_axes())
    sweeps = solve(nodes)
    rows = make_rows(nodes)
    cpu_s = round(time.process_time() - began)
    keep_table("floor", STUDY / f"{TABLE}.parquet", rows, TABLE, sweeps=sweeps, cpu_s=cpu_s)


if __name__ == "__main__":
    main()

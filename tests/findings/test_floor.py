"""The table of least settling times: against shooting, against a collocation that is not ours, and its edges."""

import functools
import math

import numpy as np
import pytest
from support import collocation

from bench.findings.floor import (
    Grid,
    ReducedStart,
    find_coordinates,
    find_floor,
    find_start,
    interpolate,
    measure_starts,
    read_grid,
)
from bench.findings.theory.bang_bang import least_time
from bench.findings.theory.time_optimal import certain_least_time, least_settling_time
from bench.studies.floor import LAST_MIXTURE, make_nodes, make_rows, place_bodies, seed_nodes, spread
from tasks.situation import KP, Situation

SITUATIONS = 20
"""Drawn situations, a start each."""

GUESSES, TRIES = 40, 3
"""Guesses of each shooting and of each collocation."""

FASTEST = 4.0
"""Greatest speed that is drawn [sqrt(a)]: up to there 40 intervals of a collocation are enough."""


@functools.cache
def draw_starts():
    """Return the numbers of a start of each of SITUATIONS situations: bound and spin drawn, some at rest."""
    rng = np.random.default_rng(20261202)
    quats, omegas, bounds = [], [], []
    while len(quats) < SITUATIONS:
        bound = float(np.exp(rng.uniform(math.log(0.05), math.log(3.0))))
        spin = float(rng.uniform(0.0, 3.0))
        if spin <= FASTEST * math.sqrt(bound):
            situation = Situation(bound=bound, spin=spin)
            [start] = situation.starts(1, 0)
            quats.append(start.quat_wxyz)
            omegas.append(start.omega)
            bounds.append(KP * bound)
    return np.array(quats), np.array(omegas), np.array(bounds)


@functools.cache
def shoot(number):
    """Return the least settling time of a drawn start by shooting [s]."""
    quats, omegas, bounds = draw_starts()
    return least_settling_time(quats[number], omegas[number], bounds[number], GUESSES)


def look_up(number):
    """Return the floor of a drawn start from the table [s]."""
    quats, omegas, bounds = draw_starts()
    floor = find_floor(quats[[number]], omegas[[number]], bounds[number])
    assert floor.is_known.all()
    return floor.times[0]


@pytest.mark.slow
def test_table_is_what_shooting_finds():
    ratios = np.array([look_up(number) / shoot(number) for number in range(SITUATIONS)])
    errors = np.abs(ratios - 1.0)
    assert np.sort(errors)[-3] <= 0.01
    assert errors.max() <= 0.05


@pytest.mark.slow
def test_no_collocation_of_twenty_situations_is_faster_and_most_are_as_fast():
    quats, omegas, bounds = draw_starts()
    program = collocation.make_program()
    rng = np.random.default_rng(11)
    ratios = []
    for number, bound in enumerate(bounds):
        ours = shoot(number) * math.sqrt(bound)
        start = np.concatenate([quats[number], omegas[number] / math.sqrt(bound)])
        angle = 2.0 * math.acos(min(1.0, abs(quats[number, 0])))
        times = [
            collocation.solve(program, start, 0.02 * angle, 1.6 * ours, rng) for _ in range(TRIES)
        ]
        ratios.append(min(times) / ours)
    # Below 1 by what is seen as flat and by the nodes between which the band is not watched; above it
    # by the division into 40 parts.
    assert min(ratios) >= 1.0 - 1e-3
    agreeing = [ratio for ratio in ratios if ratio <= 1.0 + 5e-3]
    assert len(agreeing) >= 14


def test_floor_from_rest_is_the_closed_form():
    angles = np.array([0.05, 0.3, 1.0, 2.0, 3.1])
    zero = np.zeros_like(angles)
    quats = np.stack([np.cos(0.5 * angles), np.sin(0.5 * angles), zero, zero], axis=1)
    floor = find_floor(quats, np.zeros((5, 3)), 10.0)
    expected = [least_time(angle, 10.0) for angle in angles]
    assert floor.times == pytest.approx(expected, rel=2e-3)


def test_floor_lies_above_the_proved_bound_and_is_it_beyond_the_table():
    rng = np.random.default_rng(3)
    quats = rng.standard_normal((500, 4))
    quats /= np.linalg.norm(quats, axis=1, keepdims=True)
    omegas = rng.standard_normal((500, 3)) * rng.uniform(0.0, 25.0, (500, 1))
    floor = find_floor(quats, omegas, 10.0)
    assert (floor.times >= floor.certain).all()
    assert (floor.times[~floor.is_known] == floor.certain[~floor.is_known]).all()
    assert floor.is_known.any()
    assert not floor.is_known.all()
    start = measure_starts(quats, omegas, 10.0)
    for number in range(5):
        speed = start.speed[number] * math.sqrt(10.0)
        certain = certain_least_time(start.angle[number], speed, 10.0)
        assert floor.certain[number] == pytest.approx(certain, rel=1e-12)


def test_floor_does_not_depend_on_the_frame_and_scales_with_the_bound():
    quat = np.array([[0.5, 0.5, -0.5, 0.5]])
    omega = np.array([[1.0, 2.0, -0.5]])
    # The same turn and spin with the axes renamed.
    renamed = np.array([[0.5, 0.5, 0.5, -0.5]]), np.array([[-0.5, 1.0, 2.0]])
    floor = find_floor(quat, omega, 4.0)
    assert find_floor(*renamed, 4.0).times == pytest.approx(floor.times, rel=1e-12)
    assert find_floor(-quat, omega, 4.0).times == pytest.approx(floor.times, rel=1e-12)
    faster = find_floor(quat, 3.0 * omega, 36.0)
    assert 3.0 * faster.times == pytest.approx(floor.times, rel=1e-12)


def test_spin_to_the_goal_has_the_cosine_minus_one():
    turn = np.array([[math.cos(0.4), 0.0, 0.0, math.sin(0.4)]])
    start = measure_starts(turn, np.array([[0.0, 0.0, -2.0]]), 4.0)
    assert start.angle == pytest.approx([0.8])
    assert start.speed == pytest.approx([1.0])
    assert start.cosine == pytest.approx([-1.0])


def test_coordinates_lead_back_to_the_start():
    angle = np.array([0.1, 1.0, 3.0, 3.0])
    speed = np.array([0.0, 2.0, 0.3, 7.0])
    start = ReducedStart(angle, speed, np.array([0.2, -1.0, 1.0, 0.0]))
    back = find_start(*find_coordinates(start))
    for before, after in zip(start, back, strict=True):
        assert after == pytest.approx(before, abs=1e-7)


def test_interpolation_is_exact_where_the_ratio_is_linear():
    axes = (np.array([0.5, 1.0, 2.5]), np.array([0.0, 0.4, LAST_MIXTURE]), np.array([-1.0, 0.3, 1.0]))
    energy, mixture, cosine = np.meshgrid(*axes, indexing="ij")
    grid = Grid(axes, 1.0 + 2.0 * energy - mixture + 0.5 * cosine)
    places = np.array([[0.6, 2.5, 1.0], [0.1, 1.52, 0.4], [-0.9, 1.0, 0.3]])
    expected = 1.0 + 2.0 * places[0] - places[1] + 0.5 * places[2]
    assert interpolate(grid, places) == pytest.approx(expected, rel=1e-12)


def test_table_is_whole():
    grid = read_grid()
    assert np.isfinite(grid.ratios).all()
    assert (grid.ratios > 0.0).all()
    energy, mixture, cosine = np.meshgrid(*grid.axes, indexing="ij")
    start = find_start(energy, mixture, cosine)
    certain = certain_least_time(start.angle, start.speed, 1.0)
    assert (grid.ratios * energy >= certain * (1.0 - 2e-4)).all()


def test_study_spreads_an_extremal_from_a_seed_to_its_neighbours():
    axes = (np.array([1.2, 1.25]), np.array([0.6, 0.65]), np.array([0.1, 0.15, 0.2]))
    nodes = make_nodes(axes)
    is_new = seed_nodes(nodes)
    assert is_new.sum() == 1
    spread(nodes, is_new)
    rows = make_rows(nodes)
    bodies = place_bodies(nodes.start)
    assert np.isfinite(nodes.times).all()
    for number in (3, 11):
        quat, omega = bodies.quat[:, number], bodies.omega[:, number]
        expected = least_settling_time(quat, omega, 1.0)
        assert rows["time"][number] == pytest.approx(expected, rel=2e-3)

"""Contracts that every contender keeps, of whatever kind; a new file, and a new kind, are under them unnamed."""

import inspect
import itertools
import math
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.command_line import bench
from support.in_contact import IMPEDANCES
from support.states import directions, of_scipy

from bench.law.contender import bind
from bench.law.contenders import registry
from bench.law.inputs import Gains, Goal
from bench.law.kinds import HasLaw
from bench.law.scalar import KERNELS
from bench.law.shipped import ANTIPODE, NEAR, POSITION, TORQUE, VELOCITY
from bench.law.so3 import IDENTITY

EVERY = [
    pytest.param(kind, one, id=f"{kind}-{one.name}")
    for kind in registry.FOLDERS
    for one in registry.contenders(kind).values()
]
PLAIN = {"refuses", "polynomial", "bound"}
"""Functions of a record that no loop calls."""

on_every = pytest.mark.parametrize(("kind", "one"), EVERY)


def read_comment(kind, one):
    """What its file says of it first."""
    word = one.name.replace("-", "_")
    declared = Path(registry.__file__).parent / kind / f"{word}.toml"
    if declared.exists():
        return declared.read_text().partition("\n\n")[0]
    return inspect.getdoc(import_module(f"bench.law.contenders.{kind}.{word}"))


@on_every
def test_contender_says_what_it_is_and_where_it_is_from(kind, one):
    assert one.title
    assert one.source
    assert getattr(one.law if isinstance(one, HasLaw) else one, "formula", "none")
    assert read_comment(kind, one)


@on_every
def test_functions_of_a_contender_are_kernels(kind, one):
    every = vars(one) | one.law._asdict() if isinstance(one, HasLaw) else one._asdict()
    called = {field: value for field, value in every.items() if inspect.isfunction(value)}
    assert [
        field for field in called.keys() - PLAIN if not field.endswith("_in") and called[field] not in KERNELS
    ] == []


def test_laws_and_impedances_in_coordinates_are_kernels():
    assert [one.name for one in registry.all_contenders() if one.law not in KERNELS] == []
    made = {one.name: bind(one.impedance, one.representation) for one in IMPEDANCES}
    assert [name for name, law in made.items() if law not in KERNELS] == []


def test_every_contender_is_listed(capsys):
    listed = {line.split()[0] for line in bench(capsys, "list").out.splitlines() if line.strip()}
    assert {one.name for kind in registry.FOLDERS for one in registry.contenders(kind).values()} <= listed


SIZES = (1e-9, 1e-3, 0.2, 1.0, 2.5, 3.1, math.pi)


on_shipped = pytest.mark.parametrize("one", registry.contenders("shipped").values())


@on_shipped
def test_fields_say_what_it_is_and_its_source_is_pinned(one):
    assert all((one.path, one.set_by))
    assert one.level in {TORQUE, VELOCITY, POSITION}
    assert (one.gains.kv == 0.0) == (one.level == VELOCITY)
    assert one.gains.kp > 0.0
    repository, _, revision = one.source.partition("@")
    assert repository.count("/") == 1
    assert revision.startswith("v") or (len(revision) == 40 and int(revision, 16))


@on_shipped
def test_error_is_zero_at_the_goal_and_that_of_the_opposite_turn_is_the_opposite(one):
    assert not any(one.error((1.0, 0.0, 0.0, 0.0)))
    for k, theta in itertools.product(directions(40, 19), SIZES):
        w, (x, y, z) = math.cos(theta / 2.0), (math.sin(theta / 2.0) * k).tolist()
        np.testing.assert_array_equal(one.error((w, -x, -y, -z)), np.negative(one.error((w, x, y, z))))


@on_shipped
def test_law_is_the_error_times_the_gains_and_a_damper(one):
    law, gains, omega = one.law.law, Gains(3.0, 5.0), (0.25, -0.5, 1.0)
    drawn = ScipyRotation.random(20, rng=np.random.default_rng(3))
    for turn, sheet in zip(drawn, [NEAR, ANTIPODE] * 10, strict=True):
        u, q = law(of_scipy(turn), omega, Goal(IDENTITY), gains, sheet)
        assert np.dot(q, sheet) >= 0.0
        assert np.linalg.norm(q) == pytest.approx(1.0, abs=1e-15)
        np.testing.assert_allclose(u, 3.0 * np.array(one.error(q)) - 5.0 * np.array(omega), rtol=1e-14)

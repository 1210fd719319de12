"""Contracts that every perturbation in tasks/conditions and every experiment keeps; new files are under them."""

import dataclasses
import math

import numpy as np
import pytest
from support.bits import same_bits
from support.driving import METRICS, settings
from support.each import each

import tasks
from bench.base.errors import Incompatible
from bench.engines.plants.hooks import check
from bench.engines.plants.perturbed import steps_of
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments import plan
from bench.experiments.experiment import known_experiments
from bench.experiments.request import KINDS, Request
from bench.findings import perturbed
from bench.law.contenders.registry import find_contender
from tasks.axis import Axis, Field
from tasks.condition import FIELDS, Condition, condition_at, declared_fields
from tasks.errors import BadValue

AXES = [tasks.axis(name) for name in tasks.axis_names()]

axis = each(AXES)


def test_it_is_named_as_its_file_says_what_it_is_and_levels_grow_the_nominal_one_among_them(axis):
    assert tasks.axis(axis.name) is axis
    assert axis.title
    assert axis.unit
    assert len(axis.levels) > 1
    assert np.all(np.diff(axis.levels) > 0)
    assert axis.nominal is None or axis.nominal in axis.levels


def test_at_its_nominal_level_nothing_is_wrong(axis):
    if axis.nominal is None:
        assert Condition() not in [condition_at(axis, level) for level in axis.levels]
    else:
        assert condition_at(axis, axis.nominal)._replace(feedforward=Condition().feedforward) == Condition()


def test_each_level_differs_from_the_others_in_condition_or_starts(axis):
    met = [(condition_at(axis, level), tuple(axis.starts(3, 0, level))) for level in axis.levels]
    assert len(set(met)) == len(met)


def test_conditions_are_of_this_world(axis):
    for level in axis.levels:
        met = condition_at(axis, level)
        x, y, z = sorted(met.inertia)
        assert x > 0.0
        assert x + y >= z * (1.0 - 1e-12)
        assert met.period_s > 0.0
        assert met.bound > 0.0
        assert min(met.delay_s, met.attitude_noise, met.rate_noise) >= 0.0
        assert min(met.worst_attitude_error, met.reference_amplitude) >= 0.0


def test_delays_are_whole_steps_of_the_plant(axis):
    for level in axis.levels:
        met = condition_at(axis, level)
        steps = met.delay_s / (met.period_s / steps_of(met))
        assert steps == pytest.approx(round(steps), abs=1e-9)


@pytest.mark.parametrize("seed", [0, 7])
def test_starts_are_as_many_as_asked_for_and_differ(axis, seed):
    for level in axis.levels:
        starts = axis.starts(12, seed, level)
        assert len({one.id for one in starts}) == len({one.quat_wxyz for one in starts}) == 12
        assert axis.starts(5, seed, level) == starts[:5]
        for one in starts:
            assert math.hypot(*one.quat_wxyz) == pytest.approx(1.0, abs=1e-15)


def rows(law, starts, condition):
    horizon = settings(horizon_s=1.0)
    return run_disturbed(find_contender(law), starts, condition, horizon, METRICS)


@pytest.mark.slow
def test_its_last_level_changes_rows(axis):
    directions = [direction for direction in perturbed.directions() if direction.axis == axis.name]
    assert directions
    for direction in directions:
        mildest, *_, last = direction.levels_outward(axis.levels)
        mild, perturbing = condition_at(axis, mildest), condition_at(axis, last)
        starts = axis.starts(4, 0, last)
        # Where no field differs, as with a spin, the starts must do it.
        others = starts if mild != perturbing else axis.starts(4, 0, mildest)
        changed = rows("rotation-matrix", starts, perturbing)
        assert not same_bits(changed, rows("rotation-matrix", others, mild))


@pytest.mark.slow
@pytest.mark.parametrize("field", FIELDS, ids=[field.name for field in FIELDS])
def test_field_changes_rows_of_a_law_with_memory_where_an_axis_sets_it(field):
    """So every hook acts, also one that no axis sets alone."""
    assert any(changes_rows(field, axis, level) for axis in AXES for level in axis.levels)


def changes_rows(field, axis, level):
    """Tell whether a field changes rows at a level of an axis; the other fields stay there."""
    perturbing, starts = condition_at(axis, level), axis.starts(8, 0, level)
    without = perturbing._replace(**{field.name: field.default})
    if perturbing == without:
        return False
    return not same_bits(rows("hybrid", starts, perturbing), rows("hybrid", starts, without))


def add(level, omega, now):
    return (omega[0] + level, omega[1], omega[2])


def bias(default=0.0, lasts=True, **hooks):
    return Field("bias", default, "none", lasts, **hooks)


REFUSED = [
    ([bias(lasts=None, measured_rate=add)], "py: the field 'bias' does not say whether .* lasts; give"),
    ([bias(measured_rate=add)] * 2, "'bias' is declared by two files"),
    ([bias(default=(0.0, 0.0), measured_rate=add)], "must be a number or three numbers"),
    (
        [bias()],
        r"one\.py: the field 'bias' has no hook, so it would perturb nothing; the hooks are measured_rate, .*, inertia "
        r".*\(try in the field: measured_rate=lambda level, omega, now: \(omega\[0\] \+ level",
    ),
    (
        [bias(in_loop=True)],
        r"'bias' is not read by the loop, which reads period_s, delay_s, .* \(give it a hook\)",
    ),
]


@pytest.mark.parametrize(("fields", "reason"), REFUSED)
def test_field_that_would_not_act_as_it_says_is_refused(fields, reason):
    with pytest.raises(BadValue, match=reason):
        declared_fields({"one": AXES[0]._replace(fields=tuple(fields))})


def test_axis_without_field_or_level_or_start_of_its_own_is_refused():
    reason = r"conditions/one\.py: AXIS has neither fields nor sets nor starts"
    with pytest.raises(BadValue, match=reason):
        declared_fields({"one": Axis("one", "One", "1", (0.0, 1.0), 0.0)})


@pytest.mark.parametrize(
    ("hooks", "reason"),
    [
        (
            {"measured_rate": lambda level, omega: omega},
            r"measured_rate of the field 'bias' raises TypeError: .*3 were given \(see Field in tasks",
        ),
        ({"measured_turn": lambda level, R, now: R + level}, "raises TypeError: can only concat"),
        ({"measured_away": lambda level, angle, now: now.speed}, "AttributeError: .* 'speed'"),
        (
            {"commanded": lambda level, u, now: [*u]},
            r"returns \[0.5, 1.0, 2.0\]; allowed are floats in tuples, as in \(0.5, 1.0, 2.0\)",
        ),
        ({"commanded": lambda level, u, now: (0, *u[1:])}, r"returns \(0, 1.0, 2.0\)"),
        ({"goal": lambda level, R, time_s: (R, (0.0, 0.0, 0.0))}, "returns .* as in"),
    ],
)
def test_hook_that_the_plant_cannot_call_or_use_is_refused(hooks, reason):
    [kind] = hooks
    with pytest.raises(BadValue, match=reason):
        check(bias(**hooks), kind)


def test_hook_may_have_levels_that_it_never_meets():
    check(bias(measured_away=lambda level, angle, now: math.sqrt(0.5 - level)), "measured_away")


def test_axis_that_sets_an_undeclared_field_is_refused():
    with pytest.raises(BadValue, match="'delay' sets 'dela', a field that no file of tasks/conditions declares"):
        condition_at(tasks.axis("delay")._replace(sets=lambda level: {"dela": level}), 0.0)


NAMED = {
    "tasks": "free-body",
    "start_sets": "half-turn",
    "engines": "native",
    "arms": "ur5e",
    "jacobians": "geometric",
    "inverses": "solve",
    "variations": "mass-1.30",
    "controllers": "impedance-geometric",
    "regulators": "rotation-matrix",
    "representations": "zyx-euler",
    "axes": "delay",
}
LAWS = (find_contender("rotation-matrix"), find_contender("linearized-euler/zyx-euler"))


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMED)
def test_named_word_leaves_only_experiments_that_take_it(kind):
    made = plan.make(Request("quick", LAWS, **{kind: (NAMED[kind],)}))
    planned = {unit.experiment for unit in made.units}
    assert planned
    assert planned <= {one.name for one in known_experiments().values() if kind in one.takes}


def test_every_kind_of_word_is_tried_here():
    words = {field.name for field in dataclasses.fields(Request) if field.type == "tuple[str, ...]"}
    assert {*NAMED} == {*KINDS} == words - {"experiments"}


@pytest.mark.parametrize("one", known_experiments().values())
def test_word_that_a_named_experiment_does_not_take_is_refused(one):
    for kind in NAMED.keys() - {*one.takes}:
        with pytest.raises(Incompatible, match=f"'{NAMED[kind]}' cannot narrow the experiment '{one.name}'"):
            plan.make(Request("quick", LAWS, **{kind: (NAMED[kind],)}, experiments=(one.name,)))

"""A law can read the bound of its command and the delay; a law that does not read them is unchanged."""

import math
import subprocess

import numpy as np
import pytest
from support.exported import needs, written
from support.limited import CASCADE, SHOWS, write_law

import tasks
from bench.engines.episode import FIRST_METRIC, Settings
from bench.engines.metrics.registry import known_metrics
from bench.engines.simulate_bodies import run_disturbed
from bench.experiments.situations import plan_of, run_starts
from bench.export.subject import find_subject
from bench.findings.proofs import dialect
from bench.findings.proofs.reasons import Untraceable
from bench.law.contender import Contender
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import Gains, Goal, Tuning, reads_limits
from bench.law.so3 import from_quaternion
from tasks.condition import Condition
from tasks.situation import Situation

README = Situation(zeta=0.7, bound=0.075, delay=0.1, period=0.04)
"""The situation of README's question: kp = 400, kv = 28, bound 30, 5 ms, 500 Hz."""


STATE = from_quaternion((0.8, 0.6, 0.0, 0.0)), (0.1, 0.2, 0.3), Goal()
"""R, omega and the goal of a call."""


@pytest.fixture
def shows(tmp_path):
    return Contender(load_law(write_law(tmp_path, SHOWS)))


@pytest.fixture
def cascade(tmp_path):
    return Contender(load_law(write_law(tmp_path, CASCADE)))


KNOW_THEIR_MOTOR = (
    "boskovic",
    "braking-cascade",
    "braking-cascade-memory",
    "braking-feedforward",
    "wie-bailey-heiberg",
    "wie-bailey-heiberg-memory",
)
"""The laws that read a limit."""


def commanded(one, condition):
    """Return the greatest command of 50 ms, from rest [rad/s^2]."""
    starts = tasks.start_set("uniform", 1, 0)
    settings = Settings(Gains(), 1e-3, 50, 51)
    [row] = run_disturbed(one, starts, condition, settings, (known_metrics()["peak_u"],))
    return math.sqrt(row[FIRST_METRIC])


@pytest.mark.parametrize("bound", [3.0, 40.0, math.inf])
@pytest.mark.parametrize("delay_s", [0.0, 0.02])
def test_law_is_told_the_bound_and_the_delay_of_its_condition(shows, bound, delay_s):
    told = 1.0 if bound == math.inf else 0.5 * bound
    found = commanded(shows, Condition(bound=bound, delay_s=delay_s))
    assert found == pytest.approx(math.hypot(told, delay_s), rel=1e-12)


def test_law_without_a_condition_has_no_limits(shows):
    assert shows.law(*STATE, Tuning()) == (1.0, 0.0, 0.0)
    assert commanded(shows, Condition()) == 1.0


def test_limits_are_found_in_the_law_and_in_what_it_calls(shows, cascade):
    assert reads_limits(shows.law)
    assert reads_limits(cascade.law)
    laws = [one for one in all_contenders() if one.representation is None]
    assert len(laws) > 20
    assert {one.name for one in laws if reads_limits(one.law)} == {*KNOW_THEIR_MOTOR}


def test_other_laws_answer_the_same_with_limits_and_without():
    for name in ("hybrid", "rotation-matrix", "quaternion-shortest"):
        one = find_contender(name)
        memory = () if one.regulator.memory is None else ((1.0, 1.0, 0.0, 0.0),)
        plain = one.law(*STATE, Gains(), *memory)
        assert one.law(*STATE, Tuning(bound=3.0, delay=0.1), *memory) == plain


def test_rate_that_can_be_braked_does_not_overshoot_where_motors_are_weak(cascade):
    settings = plan_of([(cascade, README)]).request
    found = {}
    for one in (cascade, find_contender("hybrid")):
        rows = run_starts(settings, one, README, README.starts(128, 0), README.condition())
        found[one.name] = float(np.quantile(rows["time"], 0.99)), float(rows["overshoot"].max())
    (fast, little), (slow, much) = found.values()
    assert little < 2.0 < 80.0 < much
    assert 2.0 * fast < slow


def test_export_takes_the_limits_as_arguments(cascade, tmp_path):
    subject = find_subject(cascade.name, (cascade.regulator,))
    entry = subject.entries[0]
    assert [one.name for one in entry.parameters] == ["R", "omega", "R_d", "gains"]
    assert entry.parameters[-1].size == 4
    header = (written(subject, "c", tmp_path) / f"{subject.identifier}.h").read_text()
    assert "double kp, double kv, double bound, double delay" in " ".join(header.split())
    assert "Motors    bound" in header


@needs("cc")
def test_exported_law_with_limits_answers_its_vectors(cascade, tmp_path):
    here = written(find_subject(cascade.name, (cascade.regulator,)), "c", tmp_path)
    build = "cc -std=c99 -O2 -ffp-contract=off -o run *.c -lm && ./run"
    said = subprocess.run(build, shell=True, cwd=here, capture_output=True, text=True, check=True).stdout
    assert ": 0 of " in said


def test_proof_of_a_law_that_reads_a_bound_is_refused_with_the_reason(cascade):
    reason = r"it reads gains\.bound, and the theorems are about a command without limits"
    with pytest.raises(Untraceable, match=reason):
        dialect.check(cascade.regulator)

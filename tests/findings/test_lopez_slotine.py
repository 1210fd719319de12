"""The claims of Lopez and Slotine: the laws' form, the episodes that they compute, their texts, and their commands."""

import math
import shlex

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.spatial.transform import Rotation as ScipyRotation

from bench.cli import claims as command
from bench.cli import run as run_command
from bench.experiments.probes import sliding as probe
from bench.experiments.probes.body_frame import IN_BODY_FRAME
from bench.experiments.probes.commands import command as command_of
from bench.experiments.request import Request
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.findings.claims.lopez_slotine_2024 import attitude
from bench.findings.claims.verdict import LONGEST_MEASURED, Word
from bench.law.contenders.regulators import sliding
from bench.law.inputs import Gains, Goal
from bench.law.so3 import IDENTITY, from_quaternion
from tasks.base import Start

PAPER = "lopez-slotine-2024"
CLAIMS = claims.all_claims(PAPER)
GAINS = (Gains(), Gains(100.0, 25.0))
"""A double pole, and two real poles."""
STEP_S = 1e-6


def random_states(seed, count=20):
    """Return random turns from the body to the goal at zero rotation, and rates [rad/s]."""
    draw = np.random.default_rng(seed)
    bodies = ScipyRotation.random(count, random_state=seed)
    return list(zip(bodies, draw.normal(size=(count, 3)) * 5.0, strict=True))


def shorter_vector(body):
    """Return eps of the turn to the goal on the side eta >= 0, by scipy."""
    quat = body.inv().as_quat(scalar_first=True, canonical=True)
    return quat[1:]


def sliding_variable(body, omega, rates):
    """Return omega - lambda eps, base frame."""
    return omega - rates.surface * shorter_vector(body)


def test_turn_about_an_axis_is_the_one_of_scipy():
    for axis in probe.AXES:
        quat = ScipyRotation.from_rotvec(2.0 * np.array(axis)).as_quat(scalar_first=True)
        assert probe.turn_about(axis, 2.0).quat_wxyz == pytest.approx(tuple(quat))


@pytest.mark.parametrize("gains", GAINS)
def test_law_makes_the_sliding_variable_decay_in_the_base_frame(gains):
    rates = probe.rates_of(gains)
    for body, omega in random_states(1):
        u = command_of("sliding", from_quaternion(tuple(body.as_quat(scalar_first=True))), tuple(omega), gains=gains)
        later = ScipyRotation.from_rotvec(STEP_S * omega) * body
        s, s_later = sliding_variable(body, omega, rates), sliding_variable(later, omega + STEP_S * u, rates)
        assert (s_later - s) / STEP_S == pytest.approx(-rates.approach * s, abs=2e-2)


def test_law_in_the_body_frame_makes_its_variable_decay_there():
    gains = Gains()
    rates = probe.rates_of(gains)
    for body, omega in random_states(2):
        R = from_quaternion(tuple(body.as_quat(scalar_first=True).tolist()))
        u = np.array(IN_BODY_FRAME.law(R, tuple(omega.tolist()), Goal(IDENTITY), gains))
        later = ScipyRotation.from_rotvec(STEP_S * omega) * body
        s = body.inv().apply(sliding_variable(body, omega, rates))
        s_later = later.inv().apply(sliding_variable(later, omega + STEP_S * u, rates))
        assert (s_later - s) / STEP_S == pytest.approx(-rates.approach * s, abs=2e-2)


def test_law_with_memory_has_the_same_command_before_a_half_turn():
    from bench.law.contenders.regulators import sliding_memory

    for body, omega in random_states(3):
        R, goal = from_quaternion(tuple(body.as_quat(scalar_first=True).tolist())), Goal(IDENTITY)
        rate = tuple(omega.tolist())
        u, _ = sliding_memory.law(R, rate, goal, Gains(), (1.0, 0.0, 0.0, 0.0))
        assert u == pytest.approx(sliding.law(R, rate, goal, Gains()))


def test_rates_multiply_to_the_spring_of_the_law():
    for gains in GAINS:
        surface, approach = probe.rates_of(gains)
        assert surface * approach == pytest.approx(2.0 * gains.kp)


def measured(measure, gains=GAINS[0], seed=0):
    """Return the numbers of a probe by the name of their measure."""
    found = {}
    for one in measure(Request(gains=gains, seed=seed), None):
        found.setdefault(one.measure, []).append(one.value)
    return found


def test_tangent_of_a_quarter_angle_decays_at_half_lambda_and_the_chord_does_not():
    found = measured(probe.measure_decay)
    assert max(found["decay_gap"]) < 1e-6
    # the chord decays at (lambda/2) cos(theta/2): from 179 degrees at first
    assert found["first_rate_per_s"][-1] == pytest.approx(10.0 * math.cos(math.radians(89.5)), rel=1e-2)
    assert found["last_rate_per_s"][-1] == pytest.approx(10.0, rel=1e-3)


@pytest.mark.parametrize("gains", GAINS)
def test_no_start_exceeds_the_bound_which_all_have_at_first(gains):
    shares = measured(probe.measure_bound, gains, seed=3)["share_of_bound"]
    assert 1.0 - 1e-9 < max(shares) < 1.0 + 1e-6


def test_both_frames_have_one_angle_and_from_spinning_starts_two_motions():
    found = measured(probe.measure_frames, seed=3)
    at_rest, spinning = found["orientation_gap"][:100], found["orientation_gap"][100:]
    assert max(found["angle_gap"]) < attitude.SAME_RAD
    assert max(at_rest) < 1e-9
    assert max(spinning) > math.radians(10.0)


@pytest.mark.parametrize(("share", "is_held"), [(3.0, True), (0.5, False)])
def test_noise_holds_the_law_without_memory_alone_if_it_exceeds_the_turn_of_a_period(share, is_held):
    for period_s in (1e-3, 1e-4):
        held = {"sliding": 0, "sliding-memory": 0}
        for one in probe.hold(Request(), period_s, share):
            held[one.words["regulator"]] += one.outcome != "settled"
            assert one.value == pytest.approx(share * 100.0 * period_s**2)
        assert held == {"sliding": 3 if is_held else 0, "sliding-memory": 0}


def test_error_vector_is_the_one_of_scipy():
    for body, _ in random_states(4):
        start = Start("", tuple(body.as_quat(scalar_first=True).tolist()))
        assert probe.error_vector(start) == pytest.approx(shorter_vector(body))


def test_claims_are_ten_and_not_among_those_of_murphy():
    assert [claim.id for claim in CLAIMS] == [f"LS{i:02d}" for i in range(1, 11)]
    assert not {claim.id for claim in claims.all_claims()} & {claim.id for claim in CLAIMS}


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_claim_has_its_texts(claim):
    assert all((claim.section, claim.sentence, claim.quote, claim.criterion, claim.written))
    assert "does not hold" in claim.criterion
    assert bool(claim.correction) == ("with a correction" in claim.criterion)
    assert not any(mark in text for text in (claim.quote, claim.criterion, claim.open) for mark in ("{", "\n"))


@pytest.fixture(scope="module")
def verdicts():
    return {one.id: one for one in claims.judge_each(Run(RESULTS / "reference"), PAPER)}


def test_measured_values_fit_a_cell_and_what_does_not_hold_has_what_is_true(verdicts):
    for verdict in verdicts.values():
        assert len(verdict.measured) <= LONGEST_MEASURED
        is_tested = verdict.word != Word.UNTESTED
        assert any(map(str.isdigit, verdict.measured)) == is_tested
        assert bool(verdict.correction) == (verdict.word in (Word.CORRECTED, Word.FAILS, Word.READING))


def test_words_on_the_committed_run(verdicts):
    assert {id: verdict.word for id, verdict in verdicts.items()} == {
        **dict.fromkeys(("LS01", "LS03", "LS05", "LS10"), Word.HOLDS),
        **dict.fromkeys(("LS07", "LS08", "LS09"), Word.UNTESTED),
        "LS02": Word.READING,
        "LS04": Word.CORRECTED,
        "LS06": Word.FAILS,
    }


def test_command_has_an_option_for_every_paper():
    [option] = [one for one in command.COMMAND.params if one.name == "paper"]
    assert tuple(option.type.choices) == tuple(claims.PAPERS)
    assert option.default == claims.MURPHY


RUNS = [claim.replay for claim in CLAIMS if claim.replay.startswith("bench run")]


@pytest.mark.parametrize("line", RUNS, ids=[line.partition("--out ")[2] for line in RUNS])
def test_replay_is_a_plan_of_bench_run(line, tmp_path):
    words = shlex.split(line)[2:]
    words[words.index("--out") + 1] = str(tmp_path / "run")
    planned = CliRunner().invoke(run_command.COMMAND, [*words, "--dry-run"])
    assert planned.exit_code == 0, planned.output
    assert "sliding" in planned.output

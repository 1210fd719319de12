"""Theorems about laws: against plain calls of the laws, scipy's motions, episodes, and faults that are planted."""

import numpy as np
import pandas as pd
import pytest
from flint import arb

from bench.experiments.tables.schema import RESULTS
from bench.findings.proofs import sampled, settling_time
from bench.findings.proofs.body import QUATERNION, RATES, FreeBody
from bench.findings.proofs.certificate import certify_apart, list_laws, read_certificates
from bench.findings.proofs.flow import enclose
from bench.findings.proofs.theorem import DoesNotFit, prove
from bench.findings.theory import isotropic
from bench.law.contenders import regulators
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import regulator
from bench.law.inputs import PAPERS_GAINS, Goal
from bench.law.so3 import Rotation, from_quaternion, rotate_back
from tasks.rules import RULES

STORED = read_certificates()
TRACED = (
    "rotation-vector",
    "rotation-matrix",
    "late-braking",
    "mrp-linearized",
    "sliding",
)

COMPARE = {"<": float.__lt__, "<=": float.__le__, ">": float.__gt__, ">=": float.__ge__, "!=": float.__ne__}


def evaluate(value, numbers):
    """A traced value as a float."""
    return float(value.value.as_expr().subs(numbers).evalf())


@pytest.mark.parametrize("word", TRACED)
def test_one_path_of_the_trace_is_what_the_law_answers(word):
    law, body, draw = regulator(word), FreeBody(), np.random.default_rng(3)
    states = [draw.normal(size=7) for _ in range(6)]
    seen = 0
    for tick in body.ticks(law):
        for state in states:
            q, omega = state[:4] / np.linalg.norm(state[:4]), 5.0 * state[4:]
            numbers = {"kp": 20, "kv": 9, "size": 1, "a": 1, "b": 0, "c": 0, "d": 0}
            numbers |= dict(zip((*QUATERNION, *RATES), (*q, *omega), strict=True))
            numbers |= {name: one.subs(numbers) for name, one in tick.path.meanings.items()}
            signs = [float(condition.polynomial.as_expr().subs(numbers)) for condition in tick.path.decisions]
            relations = [condition.relation for condition in tick.path.decisions]
            if not all(COMPARE[relation](sign, 0.0) for sign, relation in zip(signs, relations, strict=True)):
                continue
            E = from_quaternion(tuple(q))
            R = Rotation(*(rotate_back(E, column) for column in np.eye(3).tolist()))
            given = (R, tuple(omega), Goal(), PAPERS_GAINS._replace(kp=20.0, kv=9.0))
            u = law.law(*given) if law.memory is None else law.law(*given, tuple(q))[0]
            np.testing.assert_allclose([evaluate(one, numbers) for one in tick.u], u, rtol=1e-9, atol=1e-9)
            seen += 1
    assert seen == len(states)


def test_certificates_are_of_laws_that_are_there():
    assert len(STORED) >= 21
    assert set(STORED) <= {law.name for law in list_laws()}


@pytest.mark.parametrize("law", list_laws(), ids=lambda law: law.name)
def test_property_of_every_law_is_proved_from_its_source_as_the_certificates_say(law):
    proof = prove(law)
    assert proof.is_proved(), [one.statement for one in proof.lemmas if not one.is_proved]
    assert proof.stands == law.property
    if law.name not in STORED:
        pytest.skip("the law is newer than results/proofs (make prove)")
    stored = STORED[law.name]
    assert stored["is_proved"]
    assert stored["stands"] == law.property
    for name in ("V", "equilibria", "rate", "delta", "drop"):
        assert getattr(proof, name) == stored[name]


def copy_law(tmp_path, word, *changes):
    """A law's file with a name of its own, and some of its text changed."""
    text = (RESULTS.parent / regulators.__path__[0] / f"{word.replace('-', '_')}.py").read_text(encoding="utf-8")
    for old, new in ((f'name="{word}"', 'name="a-copy"'), *changes):
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "a_copy.py"
    path.write_text(text, encoding="utf-8")
    return path


CONSTANTS = [
    ("late-braking", ("EASED = 0.8", "EASED = 0.7"), "rate", 0.3),
    ("late-braking", ("0.625 + 0.125 * t", "0.5 + 0.125 * t"), "drop", 1.6666666666666667),
    ("mrp-linearized", ("SWITCH = 1.5", "SWITCH = 3.0"), "delta", 0.5),
]


@pytest.mark.parametrize(("word", "change", "name", "value"), CONSTANTS)
def test_constant_of_a_laws_file_changes_the_theorem(tmp_path, word, change, name, value):
    proof = prove(load_law(copy_law(tmp_path, word, change)))
    assert proof.is_proved()
    assert getattr(proof, name) == pytest.approx(value, rel=1e-12)
    assert STORED[word][name] != pytest.approx(value)


PLANTED = {
    "a damper of the wrong sign": ("hybrid", ("gains.kv, omega)", "-gains.kv, omega)"), "a > 0", "diverged"),
    "a spring that vanishes at 120°": ("late-braking", ("0.625 + 0.125 * t", "0.25 * t"), "f > 0", "stuck"),
    "a hysteresis of the wrong side": (
        "late-braking",
        ("memory[3] * z < 0.0", "memory[3] * z > 0.0"),
        "side",
        "creeping",
    ),
}


@pytest.mark.parametrize("fault", PLANTED)
def test_planted_fault_is_refuted_by_a_state_from_which_an_episode_fails(tmp_path, fault):
    word, change, lemma, outcome = PLANTED[fault]
    found = certify_apart(described(copy_law(tmp_path, word, change)))
    assert not found["is_proved"]
    assert any(lemma in one["statement"] for one in found["lemmas"] if not one["is_proved"])
    assert found["counterexample"]["outcome"] == outcome


FALSE_FORMS = {
    "delta > 0": ("late-braking", ("memory[3] * z < 0.0", "memory[3] * z < 0.0 and False")),  # it ignores its memory
    "one function": (
        "rotation-matrix",
        ("    return (\n", "    if n[0] + o[0] + a[0] > 0.0:\n        half = gains.kp\n    return (\n"),
    ),
}


@pytest.mark.parametrize("lemma", FALSE_FORMS)
def test_law_without_one_potential_or_one_change_of_side_is_not_proved(tmp_path, lemma):
    proof = prove(load_law(copy_law(tmp_path, *FALSE_FORMS[lemma])))
    assert any(lemma in one.statement for one in proof.lemmas if not one.is_proved)


def test_law_that_no_theorem_fits_is_not_proved():
    assert prove(regulator("linearized-euler")) is None


@pytest.mark.parametrize("word", ["square-root", "late-braking", "mrp", "sliding"])
def test_enclosure_holds_the_settling_time_of_scipys_motion(word):
    tolerance, a = arb(str(RULES.tolerance)), arb(PAPERS_GAINS.kv) / 2
    equation = settling_time.make_equation(regulator(word), PAPERS_GAINS, tolerance)
    for p in (0.4, 1.7, 2.9):
        expected = isotropic.settling(isotropic.EQUATIONS[word], p, *PAPERS_GAINS, RULES.tolerance)
        for width in (0.0, 0.01):
            low, high = enclose(equation, a, (p - width, p + width), tolerance)
            assert low - 2e-6 <= expected <= high + 2e-6
            assert high - low < (1e-3 if width else 1e-4) + 0.5 * width


@pytest.mark.parametrize("word", ["rotation-vector", "square-root"])
def test_bound_of_the_settling_time_is_that_of_the_certificate(word):
    assert settling_time.bound(regulator(word))._asdict() == STORED[word]["settling"]


@pytest.mark.parametrize(("word", "reason"), [("rotation-matrix", "equilibrium"), ("gibbs", "no bound")])
def test_law_without_a_bound_says_why(word, reason):
    with pytest.raises(DoesNotFit, match=reason):
        settling_time.bound(regulator(word))


def test_every_measured_start_at_rest_settles_within_its_bound():
    bounds = {law: one["settling"] for law, one in STORED.items() if "upper" in one["settling"]}
    assert len(bounds) >= 6
    rows = pd.read_parquet(RESULTS / "reference" / "episodes.parquet")
    rows = rows[(rows["arm"] == "") & (rows["engine"] == "ideal-rk4") & (rows["representation"] == "")]
    rows = rows[(rows[["omega0_x", "omega0_y", "omega0_z"]] == 0.0).all(axis=1) & (rows["angle0_rad"] > 1e-3)]
    for law, one in bounds.items():
        assert one["upper"] - one["lower"] <= 1e-3
        own = rows[rows["regulator"] == law]
        assert len(own) > 100 or regulator(law).in_engine
        assert (own["outcome"] == "settled").all()
        assert (own["settling_time_s"] <= one["upper"] + own["dt_s"]).all()


def test_equilibria_are_the_failure_points_that_the_command_has():
    found = pd.read_parquet(RESULTS / "reference" / "command-field.parquet")
    found = found[found["finding"] == "dead-half-turns"].set_index("regulator")["what"].astype(str)
    words = {"none": "none", "none, but the command jumps at 180°": "none", "every 180° rotation": "every"}
    for law, one in STORED.items():
        if law in found.index:
            assert found[law] == words.get(one["equilibria"], "some")


def test_limits_of_sampled_loops_are_proved():
    assert [one.is_proved for one in sampled.prove_loops()] == [True, True]

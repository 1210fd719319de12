"""Faulty laws, as people write them, are named for what they are; our own raise no false alarm."""

import pandas as pd
import pytest
from support.command_line import bench
from support.user_law import law_text

from bench.contenders.law_file import load_law
from bench.contenders.registry import all_contenders, contenders_of
from bench.experiments import command_field
from bench.experiments.experiment import Settings
from bench.findings.why.sentences import sentences
from bench.tables import read
from bench.tables.schema import RESULTS

REFERENCE = RESULTS / "reference"
WORDS = ("Regulator", "atan2", "cross", "dot", "double_sine", "kernel", "sqrt", "turn_quaternion")
DAMPED = "return (x - gains.kv * omega[0], y - gains.kv * omega[1], z - gains.kv * omega[2])"


def pulled(share: float) -> tuple[str, ...]:
    """The spring along s, the sum of n x n_d, o x o_d and a x a_d, of which kp/2 is right."""
    return (f"k, s = {share} * gains.kp, double_sine(R, goal.R)", "x, y, z = k * s[0], k * s[1], k * s[2]")


def of_product(first: str, second: str) -> tuple[str, ...]:
    """The spring of the antisymmetric part of E, E_ij = sum over k of first second; k stands for itself there."""

    def element(i: int, j: int) -> str:
        parts = ((first.replace("i", str(i)), second.replace("j", str(j))) for _ in range(3))
        return " + ".join(f"{a}[{k}] * {b}[{k}]" for k, (a, b) in enumerate(parts))

    places = zip("xyz", ((2, 1), (0, 2), (1, 0)), strict=True)
    return tuple(f"{name} = 0.5 * gains.kp * ({element(i, j)} - ({element(j, i)}))" for name, (i, j) in places)


SIDES = ("w, v, t = turn_quaternion(R, goal.R)", "k, h = 0.0, sqrt(dot(v, v))")
ALONG = "x, y, z = k * v[0], k * v[1], k * v[2]"
SIGN_OF_ZERO = (*SIDES, "if w > 0.0: k = gains.kp / sqrt(t)", ALONG)
SWAPPED = (*SIDES, "if h > 0.0: k = gains.kp * 2.0 * atan2(w, h) / h", ALONG)

FAULTY = {
    "undamped": (pulled(0.5), "return (x, y, z)", {"undamped", "no decay", "oscillation"}),
    "chattering": (SWAPPED, DAMPED, {"swapped atan2", "jump at the goal", "singular goal", "chatter"}),
    "row-first": (of_product("goal.R[i]", "R[j]"), DAMPED, {"row first", "no decay", "pulls away"}),
    "half-gain": (pulled(0.25), DAMPED, {"half gain"}),
    "transposed": (of_product("R[i]", "goal.R[j]"), DAMPED, {"body frame", "no decay"}),
    "wrong-sign": (pulled(-0.5), DAMPED, {"wrong sign", "no decay", "pulls away"}),
    "sign-of-zero": (SIGN_OF_ZERO, DAMPED, {"sign(0)"}),
    "off-goal": ((*pulled(0.5), "z = z + 1e-3 * gains.kp"), DAMPED, {"no rest at the goal"}),
}
"""Law -> its spring, what it returns, and its faults, dead points apart: all but one are springs as sin(theta)."""


def text_of(name: str) -> str:
    """The file of one of FAULTY."""
    body, end, _ = FAULTY[name]
    return law_text(*body, end, name=name).replace("import Regulator, kernel, sqrt", f"import {', '.join(WORDS)}")


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Law -> its rows and the faults that are said of it."""

    def look(name: str) -> tuple[pd.DataFrame, set[str]]:
        path = tmp_path_factory.mktemp(name) / "own.py"
        path.write_text(text_of(name))
        [one] = contenders_of(load_law(path))
        rows = command_field.rows(Settings(own=(one.regulator,)), command_field.of_law(one))
        return rows.set_index("finding", drop=False), {said.fault for said in sentences(rows, 100.0, "local")} - {""}

    return {name: look(name) for name in FAULTY}


@pytest.mark.parametrize("name", FAULTY)
def test_faulty_law_is_named_for_what_it_is(found, name):
    assert found[name][1] - {"dead points"} == FAULTY[name][2]


def test_sizes_of_faults_are_those_of_the_law(found):
    def value(name, finding, column="value"):
        return found[name][0].loc[finding, column]

    assert value("half-gain", "stiffness") == pytest.approx(0.5, abs=1e-7)
    assert value("half-gain", "small-error") == pytest.approx(10.0 - 50.0**0.5, abs=1e-6)  # s^2 + 20 s + 50 = 0
    assert value("row-first", "stiffness") == pytest.approx(-1.0, abs=1e-7)
    assert value("chattering", "jump-goal") == pytest.approx(6.283185, abs=1e-5)  # from -pi to pi
    assert value("sign-of-zero", "jump-half-turns") == pytest.approx(4.0, abs=1e-6)
    assert value("off-goal", "goal") == pytest.approx(1e-3, rel=1e-9)
    assert value("undamped", "rest", "found") == 20


def test_dead_half_turns_are_the_set_that_they_form(found):
    assert found["undamped"][0].loc["dead-half-turns", ["what", "found"]].tolist() == ["every", 200]
    assert found["off-goal"][0].loc["dead-elsewhere", "found"] > 0


def test_our_own_laws_raise_no_false_alarm():
    """Controls apart. Laws in Euler angles are dead where those are singular, Z-Y-Z angles at the goal itself."""
    table = read.table(REFERENCE, "command-field")
    laws = [one for one in all_contenders() if not (one.regulator.costing_only or one.regulator.control)]
    rows = {one: table[table["contender"] == one.name] for one in laws}
    faults = {one.name: {s.fault for s in sentences(rows[one], 100.0, one.regulator.property)} - {""} for one in laws}
    singular = {
        "zyx-euler": {"dead points"},
        "xyz-euler": {"dead points"},
        "zyz-euler": {"dead points", "singular goal"},
    }
    assert len(laws) == 22
    assert all(len(own) == 16 for own in rows.values())
    for one in laws:
        assert faults[one.name] <= singular.get(one.representation.name if one.representation else "", set()), one.name


def test_bench_judge_says_why_and_fails(capsys, tmp_path):
    path = tmp_path / "own.py"
    path.write_text(text_of("half-gain"))
    said = bench(capsys, "judge", path)
    assert said.code == 1, said
    assert "half gain" in said.out.splitlines()[0]
    assert "breaks it first" in said.out
    assert "half-gain  " in said.out


def test_bench_judge_finds_no_fault_in_a_law_that_has_none(capsys, tmp_path):
    path = tmp_path / "own.py"
    sided = (*SIDES, "k = gains.kp / sqrt(t)", ALONG)
    text = law_text(*sided, DAMPED).replace("import Regulator, kernel, sqrt", f"import {', '.join(WORDS)}")
    path.write_text(text)
    said = bench(capsys, "judge", path)
    assert said.code == 0, said
    assert said.out.startswith("mine: no fault found.")

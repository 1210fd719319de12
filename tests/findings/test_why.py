"""Faulty laws, as people write them, are named for what they are; our own raise no false alarm."""

from collections import defaultdict

import pytest
from support.command_line import bench
from support.user_law import law_text, spring_text

from bench.experiments.experiment import rows_of
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings.judge_law import ENGINE, START_SETS, describe_law, judge_laws, plan_of
from bench.findings.why import ends, sentences
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import contenders_of, find_contender
from bench.law.kinds import CONTROL

REFERENCE = RESULTS / "reference"


def pulled(share: float) -> tuple[str, ...]:
    """The spring along s, the sum of n x n_d, o x o_d and a x a_d; kp/2 is right."""
    return (f"k, s = {share} * gains.kp, double_sine(R, goal.R)", "x, y, z = k * s[0], k * s[1], k * s[2]")


def of_product(first: str, second: str) -> tuple[str, ...]:
    """The spring of the antisymmetric part of E, E_ij = sum over k of first[i][k] second[j][k]."""

    def element(i: int, j: int) -> str:
        return " + ".join(f"{first}[{i}][{k}] * {second}[{j}][{k}]" for k in range(3))

    places = zip("xyz", ((2, 1), (0, 2), (1, 0)), strict=True)
    return tuple(f"{name} = 0.5 * gains.kp * ({element(i, j)} - ({element(j, i)}))" for name, (i, j) in places)


def sided(spring: str) -> tuple[str, ...]:
    """The spring k eps, of the quaternion eta, eps = w, v over sqrt(t)/2."""
    start = ("w, v, t = turn_quaternion(R, goal.R)", "k, h = 0.0, sqrt(dot(v, v))")
    return (*start, spring, "x, y, z = k * v[0], k * v[1], k * v[2]")


def damped(share: float) -> str:
    """The command of a spring with this share of the damping."""
    return f"return ({', '.join(f'{axis} - {share} * gains.kv * omega[{i}]' for i, axis in enumerate('xyz'))})"


SWAPPED = sided("if h > 0.0: k = gains.kp * 2.0 * atan2(w, h) / h")
FAULTY = {
    "undamped": (pulled(0.5), "return (x, y, z)", {"undamped", "oscillation"}, "damping", 0.0),
    "weakly-damped": (pulled(0.5), damped(0.02), {"wrong damping", "oscillation"}, "damping", 0.02),
    "overdamped": (pulled(0.5), damped(9.0), {"wrong damping", "creeping"}, "damping", 9.0),
    "chattering": (SWAPPED, damped(1.0), {"swapped atan2", "jump at the goal", "chatter"}, "jump-goal", 6.283185),
    "row-first": (of_product("goal.R", "R"), damped(1.0), {"row first"}, "stiffness", -1.0),
    "half-gain": (pulled(0.25), damped(1.0), {"half gain"}, "stiffness", 0.5),
    "transposed": (of_product("R", "goal.R"), damped(1.0), {"body frame"}, "stiffness", 1.0),
    "wrong-sign": (pulled(-0.5), damped(1.0), {"wrong sign"}, "stiffness", -1.0),
    "sign-of-zero": (sided("if w > 0.0: k = gains.kp / sqrt(t)"), damped(1.0), {"sign(0)"}, "jump-half-turns", 4.0),
    "off-goal": ((*pulled(0.5), "z = z + 1e-3 * gains.kp"), damped(1.0), {"no rest at the goal"}, "goal", 1e-3),
}
"""Law -> its spring, what it returns, its faults, and a finding's size; the swapped one jumps from -pi to pi."""

OF_EPISODES = {"oscillation", "creeping", "chatter"}
"""Faults that only episodes show; laws without them are known by their command field alone."""
CONSEQUENCES = {"", "stuck", "lost starts", "creeping", "oscillation", "singular goal", "no number"}


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Law -> what is said of it, and its command field."""

    def look(name: str):
        path, parts = tmp_path_factory.mktemp(name) / "own.py", defaultdict(list)
        path.write_text(law_text(*FAULTY[name][0], FAULTY[name][1], name=name))
        [one] = contenders_of(load_law(path))
        plan = plan_of([one])
        for unit in plan.units:
            if unit.experiment == "command-field" or (unit.selector == "uniform" and FAULTY[name][2] & OF_EPISODES):
                parts[one.name, unit.experiment].append(rows_of(plan.request, unit))
        [field] = parts[one.name, "command-field"]
        moves = (one.name, "free-body") in parts
        said = (
            describe_law(one, parts).sentences
            if moves
            else sentences(field, one.regulator.property)
        )
        return {each.fault: each.text for each in said}, field.set_index("finding")

    return {name: look(name) for name in FAULTY}


@pytest.mark.parametrize("name", FAULTY)
def test_faulty_law_is_named_for_what_it_is(found, name):
    (said, field), (_, _, faults, finding, size) = found[name], FAULTY[name]
    assert faults <= set(said) <= faults | CONSEQUENCES
    assert field.loc[finding, "value"] == pytest.approx(size, abs=1e-6)


def test_our_own_laws_raise_no_false_alarm():
    """Controls apart. Laws in Euler angles fail where those are singular, Z-Y-Z angles at the goal itself."""
    field, run = Run(REFERENCE).table("command-field"), Run(REFERENCE).table("episodes")
    run = run[(run["arm"] == "") & (run["engine"] == ENGINE) & run["start_set"].isin(START_SETS)]
    laws = [find_contender(name) for name in field["contender"].unique()]
    assert laws
    for one in (law for law in laws if law.regulator.role != CONTROL):
        declared, rows = one.regulator.property, field[field["contender"] == one.name]
        faults = {s.fault for s in sentences(rows, declared) + ends(run[run["contender"] == one.name], declared)}
        assert len(rows) == 10
        assert faults <= (CONSEQUENCES if "euler" in one.name else {""}), one.name


RAISES = sided("k = gains.kp / sqrt(t)\n    if w < 0.2 * sqrt(t): raise ValueError('too far')")


@pytest.mark.parametrize(
    ("spring", "code", "first"),
    [
        (pulled(0.25), 1, "half gain"),
        (sided("k = gains.kp / sqrt(t)"), 0, "mine: no fault found."),
        (RAISES, 1, "mine: ValueError: too far, from "),
    ],
)
def test_bench_judge_says_why_by_exit_code_too(capsys, tmp_path, spring, code, first):
    path = tmp_path / "own.py"
    path.write_text(law_text(*spring, damped(1.0)))
    said = bench(capsys, "judge", path)
    assert said.code == code, said
    assert first in said.out.splitlines()[0]
    assert "threshold" in said.out.lower()
    assert "\nmine  " in said.out


NEAREST, TOGETHER = ", the nearest at ", "; up to 25 are lost together, and after 3 such losses all that follow"


@pytest.mark.parametrize(
    ("deed", "words"), [("raise ValueError('no')", NEAREST), ("while x == x: x = x + 1.0", TOGETHER)]
)
def test_heading_names_the_nearest_lost_start_only_of_a_law_that_raises(tmp_path, deed, words):
    path = tmp_path / "own.py"
    path.write_text(spring_text("if R.n[0] < -0.9:", f"    {deed}"))
    [judgement] = judge_laws([described(path)], limit_s=1.0)
    assert [known for known in (NEAREST, TOGETHER) if known in judgement.heading] == [words]

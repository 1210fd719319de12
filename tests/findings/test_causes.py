"""A fault that explains all is known from the command field: it is named by its cause, and no episode is run."""

import pandas as pd
import pytest
from support.command_line import bench
from support.user_law import LAW, law_text

from bench.experiments.command_field import rows
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.tables.run import Run, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings import why
from bench.findings.judge_law import judge_laws
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import contenders_of, find_contender

QUATERNION = "w, v, t = turn_quaternion(R, goal.R)"
RETURN = "return (x - d * omega[0], y - d * omega[1], z - d * omega[2])"


def of_quaternion(read_as: str, *more: str, damping: str = "gains.kv") -> str:
    """The law 2 kp vec(q), where q is read as these four expressions of w, v and t."""
    spring = ("k = gains.kp / sqrt(t)", *more, "x, y, z = k * x, k * y, k * z")
    return law_text(QUATERNION, f"w, x, y, z = {read_as}", *spring, f"d = {damping}", RETURN)


SHORTER = "if w < 0.0: k = -k"
SINE = ("s, d = double_sine(R, goal.R), gains.kv", "x, y, z = k * s[0], k * s[1], k * s[2]", RETURN)
PRODUCT = """\
@kernel
def given(R):
    w, v, t = turn_quaternion(R, IDENTITY)
    s = 0.5 / sqrt(t)
    return (-s * v[0], -s * v[1], -s * v[2], s * w)


@kernel
def product(p, q):
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


@kernel
def law("""
BOTH_XYZW = (
    law_text(
        "q, q_d = given(R), given(goal.R)",
        "w, x, y, z = product(q_d, (q[0], -q[1], -q[2], -q[3]))",
        "k, d = 2.0 * gains.kp, gains.kv",
        SHORTER,
        "x, y, z = k * x, k * y, k * z",
        RETURN,
    )
    .replace("@kernel\ndef law(", PRODUCT, 1)
    .replace("import Law", "import IDENTITY, Law")
)

CAUSES = {
    "wrong-sign": (of_quaternion("w, -v[0], -v[1], -v[2]"), "wrong sign"),
    "drives": (of_quaternion("w, v[0], v[1], v[2]", damping="-gains.kv"), "wrong damping"),
    "zero": (law_text("return (0.0 * omega[0], 0.0 * omega[1], 0.0 * omega[2])"), "no command"),
    "no-number": (law_text("k = sqrt(-1.0 - omega[0] * omega[0])", *SINE), "no number"),
    "w-with-x": (of_quaternion("v[0], w, v[1], v[2]", SHORTER), "exchanged components"),
    "w-with-z-and-no-sign": (of_quaternion("v[2], v[0], v[1], w"), "exchanged components"),
    "xyzw": (of_quaternion("v[0], v[1], v[2], w", SHORTER), "exchanged components"),
    "both-xyzw": (BOTH_XYZW, "exchanged components"),
    "x-with-y": (of_quaternion("w, v[1], v[0], v[2]"), "exchanged components"),
}
"""Law -> its text, and the one fault that is said of it."""

ORDERS = {
    "w-with-x": "(x, w, y, z)",
    "w-with-z-and-no-sign": "(z, x, y, w)",
    "xyzw": "(x, y, z, w)",
    "both-xyzw": "(x, y, z, w)",
    "x-with-y": "(w, y, x, z)",
}


def field_of(folder, text):
    """Return the rows of command-field of a law's text, in this process."""
    path = folder / "mine.py"
    path.write_text(text, encoding="utf-8")
    own = load_law(path)
    [one] = contenders_of(own)
    unit = Unit("command-field", one.name, "free-body", engine="ideal-held", count=1, total=1)
    found = pd.DataFrame(rows(Request(laws=(one,)), unit))
    return with_contender(found)


@pytest.mark.parametrize("name", CAUSES)
def test_cause_is_named_alone(tmp_path, name):
    text, fault = CAUSES[name]
    field = field_of(tmp_path, text)
    cause = why.find_cause(field, has_memory=False)
    assert {one.fault for one in why.sentences(field, "almost global", cause)} - {""} == {fault}
    assert why.find_cause(field, has_memory=True) == ""


@pytest.mark.parametrize("name", ORDERS)
def test_order_of_components_is_said_and_no_sign_is_blamed(tmp_path, name):
    field = field_of(tmp_path, CAUSES[name][0])
    said = " ".join(one.text for one in why.sentences(field, "almost global", "exchanged"))
    assert f"it takes {ORDERS[name]} for (w, x, y, z)" in said
    assert "sign(0)" not in said


def test_sign_of_zero_is_not_blamed_where_single_half_turns_are_dead():
    """The one dead axis of a law without a sign."""
    finding = {"dead-half-turns": "some", "no-number-half-turns": "none", "jump-half-turns": "jump"}
    finding |= {"stiffness": "uneven", "damping": "as-set"}
    table = pd.DataFrame({"finding": finding.keys(), "what": finding.values(), "value": 1.0})
    assert why.find_words(table, "local")["dead-half-turns"] == "some"
    table["what"] = table["what"].replace("some", "every")
    assert why.find_words(table, "local")["dead-half-turns"] == "between"


@pytest.mark.parametrize(
    ("factor", "words"), [("180.0 / 3.141592653589793", "180/pi: the error is in degrees"), ("57.0", "")]
)
def test_degrees_are_named_and_another_gain_is_not_taken_for_them(tmp_path, factor, words):
    field = field_of(tmp_path, law_text(f"k = 0.5 * {factor} * gains.kp", *SINE))
    said = {one.fault: one.text for one in why.sentences(field, "almost global")}
    assert ("wrong unit" in said) == bool(words)
    assert words in said.get("wrong unit", "")
    assert ("wrong gain" in said) == (not words)


def test_no_law_of_ours_has_such_a_cause():
    field = Run(RESULTS / "reference").table("command-field")
    memories = {str(law): find_contender(str(law)).regulator.memory for law in field["contender"].unique()}
    assert len(memories) > 20
    for law, own in field.groupby("contender", observed=True):
        assert why.find_cause(own, memories[str(law)] is not None) == "", law


def judge_units(folder, text):
    """Return the judgement of a law's text, and the experiments of the units that were run for it."""
    path, run = folder / "mine.py", []
    path.write_text(text, encoding="utf-8")
    [one] = judge_laws((described(path),), report=lambda unit: run.append(unit.experiment))
    return one, run


@pytest.mark.parametrize("name", ["wrong-sign", "zero", "xyzw"])
def test_judge_runs_no_episode_where_a_cause_is_known(tmp_path, name):
    text, fault = CAUSES[name]
    judgement, run = judge_units(tmp_path, text)
    assert judgement.faults == [fault]
    assert "No episode was run" in judgement.sentences[-1].text
    assert run == ["command-field"]


def test_judge_tries_no_perturbation_of_a_law_that_settles_nothing(tmp_path):
    undamped = of_quaternion("w, v[0], v[1], v[2]", damping="0.0 * gains.kv")
    judgement, run = judge_units(tmp_path, undamped)
    assert set(run) == {"command-field", "free-body"}
    assert "No perturbation was tried" in judgement.sentences[-1].text
    assert not any("Thresholds" in one.text for one in judgement.sentences)


def test_judge_tries_perturbations_of_a_law_that_settles(tmp_path):
    judgement, run = judge_units(tmp_path, of_quaternion("w, v[0], v[1], v[2]"))
    assert judgement.faults == []
    assert "robustness" in run


def judge(capsys, folder, text):
    """`bench judge` of a law's text."""
    path = folder / "mine.py"
    path.write_text(text, encoding="utf-8")
    return bench(capsys, "judge", path)


def test_bench_judge_of_a_wrong_sign_is_a_few_lines(capsys, tmp_path):
    said = judge(capsys, tmp_path, CAUSES["wrong-sign"][0])
    assert said.code == 1
    assert said.out.startswith("mine: 1 fault: wrong sign.\n")
    assert "No episode was run" in said.out


KEEPS = LAW.replace("@kernel", "{before}\n@kernel", 1).replace("{name}", "mine")
STATES = {
    "list": ("KEPT = [0.0]", "KEPT[0] = omega[0]"),
    "empty-list": ("KEPT = []", "KEPT.append(omega[0])"),
    "dictionary": ("KEPT = {'last': 0.0}", "KEPT['last'] = omega[0]"),
    "number": ("KEPT = 0.0", "global KEPT; KEPT = omega[0]"),
}


@pytest.mark.parametrize("name", STATES)
def test_state_in_a_global_is_refused_with_the_way_to_keep_it(capsys, tmp_path, name):
    before, line = STATES[name]
    body = f"{line}\n    return (-omega[0], -omega[1], -omega[2])"
    said = judge(capsys, tmp_path, KEEPS.replace("{before}", before).replace("{body}", body))
    assert said.code == 2
    assert "a law keeps its state only in memory=..." in said.err
    assert "--engine" not in said.err


@pytest.mark.parametrize(
    ("text", "function"),
    [
        (law_text("return (-omega[0], -omega[1], -omega[2])").replace("@kernel\n", ""), "law"),
        (
            law_text("return (half(omega[0]), -omega[1], -omega[2])").replace(
                "@kernel", "def half(x):\n    return 0.5 * x\n\n\n@kernel", 1
            ),
            "half",
        ),
    ],
)
def test_missing_kernel_is_named_with_the_line_that_lacks_it(capsys, tmp_path, text, function):
    said = judge(capsys, tmp_path, text)
    assert said.code == 2
    assert said.err.rstrip().endswith(f"put @kernel above def {function}")

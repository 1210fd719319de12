"""Words, numbers and combinations that cannot be run: one line, exit code 2, nothing touched."""

import pytest
from support.command_line import bench, refused, refused_run

import tasks
from bench.base.errors import Incompatible
from bench.experiments import plan as planning
from bench.experiments.choice import INTEGRATORS, Choice
from bench.experiments.suites import ENGINES, SUITES
from bench.law.contenders.registry import (
    find_contender,
    known_impedances,
    known_inverses,
    known_jacobians,
    known_regulators,
    known_representations,
)
from bench.law.control.contact_controller import HYBRIDS

LAWS_IN_CONTACT = sorted((*HYBRIDS, *(f"impedance-{name}" for name in known_impedances())))


@pytest.mark.parametrize(
    ("option", "word", "known"),
    [
        ("--suite", "defualt", sorted(SUITES)),
        ("--regulator", "rotation-matrx", sorted(known_regulators())),
        ("--regulator", "linearized-euler/zyx-eular", sorted(known_representations())),
        ("--representation", "zyx", sorted(known_representations())),
        ("--task", "free-bodi", sorted((*tasks.names(), *tasks.contact_names()))),
        ("--arm", "ur5", tasks.arm_names()),
        ("--jacobian", "geometrik", sorted(known_jacobians())),
        ("--inverse", "sovle", sorted(known_inverses())),
        ("--regulator", "rotation-matrix@geometrik+solve", sorted(known_jacobians())),
        ("--variation", "mass-1.3", sorted(tasks.variation_names())),
        ("--controller", "hybird-base+inverse", LAWS_IN_CONTACT),
        ("--controller", "hybrid/zyx-eular+inverse", sorted(known_representations())),
        ("--starts", "uniforn", sorted({*tasks.start_set_names(), *tasks.start_set_names(arm=True)})),
        ("--engine", "nativ", sorted(ENGINES)),
        ("--integrator", "eulr", sorted(INTEGRATORS)),
    ],
)
def test_unknown_word_lists_the_known_ones_and_guesses(capsys, finished, option, word, known):
    line = refused_run(capsys, finished, option, word)
    given = word.rpartition("/")[2].rpartition("@")[2].partition("+")[0]
    assert f"'{given}' is unknown" in line
    assert f"known: {', '.join(known)}" in line
    assert word == "zyx" or "did you mean" in line


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("list", "regulaters"), "regulators, representations, jacobians, inverses, controllers, impedances"),
        (("count", "--joints", "5"), "--joints"),
        (("count", "--joints", "6", "--arm", "panda"), "panda"),
        (("count", "--inverse", "sovle"), "solve"),
        (("count", "--arm", "pumma"), "puma560"),
        (("count", "--controller", "hybrid-base+inverse", "--joints", "6"), "--controller"),
        (("count", "--controller", "hybrid-base"), "hybrid-base+inverse"),
        (("rum",), "'run'"),
        (("run", "--sweet", "quick"), "--sweet"),
        (("run", "--count", "many"), "--count"),
        (("run", "--dt", "fast"), "--dt"),
        (("run", "--suite"), "--suite"),
        (("compare", "results/nowhere"), "results/nowhere"),
        (("compare", "results/reference"), "HEAD"),
        (("compare", "results/reference", "main"), "two revisions"),
        (("compare", "results/reference", "results/reference", "--law", "law.py"), "--law"),
        (("compare", "no-such-revision"), "no-such-revision"),
        (("show", "a", "b"), "b"),
    ],
)
def test_usage_error_is_one_line_that_names_the_word(capsys, words, named):
    line = refused(capsys, *words)
    assert named in line
    assert any(cure in line for cure in ("try: ", "give one of these", "use one", " away)"))


def test_no_command_shows_the_help(capsys):
    said = bench(capsys)
    assert (said.code, said.err) == (0, "")
    assert "compare" in said.out


@pytest.mark.parametrize("option", ["--engine", "--starts"])
def test_show_lists_what_the_run_has_when_asked_for_another(capsys, finished, option):
    line = refused(capsys, "show", finished, option, "nowhere")
    assert {"--engine": "reference", "--starts": "paper"}[option] in line


@pytest.mark.parametrize(
    ("option", "number"),
    [
        (option, number)
        for option in ("--dt", "--horizon", "--kp", "--kv")
        for number in ("0", "-1", "nan", "inf", "-inf")
    ]
    + [("--dt", "0.2"), ("--dt", "1e-9"), ("--horizon", "1e-4"), ("--horizon", "1e9"), ("--kp", "1e300")]
    + [("--count", "0"), ("--count", "-3"), ("--count", "1000001")]
    + [("--workers", "0"), ("--workers", "-1"), ("--workers", "1000"), ("--seed", "-1"), ("--seed", "4294967296")],
)
def test_impossible_number_names_the_option_and_the_range(capsys, finished, option, number):
    line = refused_run(capsys, finished, option, number)
    assert line.startswith(f"error: {option} ")
    assert any(word in line for word in ("between", "must lie", "from 0 to"))


def test_impossible_number_is_refused_in_a_dry_run_too(capsys, finished):
    refused_run(capsys, finished, "--dry-run", "--workers", "0")


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--task", "free-body", "--arm", "ur5e"), "task 'free-body' has no arm"),
        (("--task", "free-body", "--regulator", "rotation-matrix@geometric+solve"), "task 'free-body' has no arm"),
        (("--arm", "panda", "--inverse", "solve", "--jacobian", "geometric"), "a 6 x 7 Jacobian is not square; use"),
        (
            ("--arm", "ur5e", "--regulator", "rotation-matrix@analytic+solve"),
            "takes an acceleration of coordinates, and regulator 'rotation-matrix' commands an angular acceleration",
        ),
        (
            ("--regulator", "feedback-linearized/mrp@analytic-differentiated+solve"),
            "which 'mrp' does not give (try: the Jacobian analytic",
        ),
        (("--regulator", "rotation-matrix/zyx-euler"), "acts on the rotation matrix and takes no representation"),
        (("--regulator", "rotation-matrix", "--representation", "zyx-euler"), "no chosen law acts on zyx-euler"),
        (("--task", "free-body", "--starts", "clear"), "takes the starts paper"),
        (("--arm", "ur5e", "--starts", "paper"), "takes the starts clear, half-turn, pole"),
        (("--arm", "ur5e", "--engine", "ideal-rk4"), "ideal-rk4 simulates free-body alone, not 'arm-regulation'"),
        (
            ("--task", "wrench-probe", "--arm", "jaco"),
            "arm 'jaco' has no site 'wrist', where task 'wrench-probe' mounts the hand",
        ),
        (("--controller", "hybrid-base+inverse", "--arm", "jaco"), "arm 'jaco' has no site 'wrist'"),
        (("--controller", "hybrid-base"), "lacks its form (try: hybrid-base+inverse"),
        (
            ("--controller", "hybrid/quaternion+inverse"),
            "'quaternion' has no coordinate for each of the axes x, y and z",
        ),
        (("--controller", "impedance-geometric", "--task", "free-body"), "task 'free-body' takes regulators and no"),
        (
            ("--controller", "impedance-geometric", "--regulator", "rotation-matrix"),
            "no experiment takes both controllers",
        ),
        (
            ("--task", "wrench-probe", "--starts", "paper"),
            "take an arm and a --controller, no start sets",
        ),
        (("--task", "wrench-probe", "--engine", "reference"), "no engines such as 'reference'"),
        (("--task", "wrench-probe", "--inverse", "solve"), "no inverses such as 'solve'"),
        (("--controller", "impedance-geometric", "--representation", "mrp"), "acts on mrp"),
    ],
)
def test_what_does_not_go_together_is_refused_with_the_reason(capsys, finished, words, reason):
    assert reason in refused_run(capsys, finished, *words)


@pytest.mark.parametrize(
    "words",
    [
        ("--regulator", "rotation-matrix@geometric"),
        ("--regulator", "rotation-matrix@"),
        ("--regulator", "rotation-matrix@geometric+solve", "--inverse", "transpose"),
        ("--regulator", "rotation-matrix@geometric+solve", "--regulator", "linearized-euler"),
        ("--regulator", "rotation-matrix@geometric+solve", "--regulator", "rotation-matrix@geometric+transpose"),
    ],
)
def test_contender_pasted_so_that_it_would_mean_more_is_refused_with_the_cure(capsys, finished, words):
    assert "(try: --regulator rotation-matrix --jacobian geometric --inverse solve)" in refused_run(
        capsys, finished, *words
    )


def test_law_in_several_coordinates_is_refused_where_one_is_needed():
    with pytest.raises(Incompatible, match=r"name one: .*feedback-linearized/zyx-euler, feedback-linearized/zyz-euler"):
        find_contender("feedback-linearized")


def test_same_word_twice_is_the_word_once():
    laws = [_rotation_matrix()]
    once = planning.make("quick", laws, Choice(("free-body",), ("paper",), ("native",)))
    twice = planning.make("quick", laws, Choice(("free-body",) * 2, ("paper",) * 2, ("native",) * 2))
    assert once == twice


def _rotation_matrix():
    return find_contender("rotation-matrix")

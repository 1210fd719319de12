"""Words, numbers and combinations that cannot be run: one line, exit code 2, nothing touched."""

import tomllib
from pathlib import Path

import pytest
from support.command_line import refused, refused_run

import tasks
from bench.experiments import plan as planning
from bench.experiments.request import INTEGRATORS, Request
from bench.experiments.suites import ENGINES, SUITES
from bench.experiments.tables.schema import RESULTS
from bench.law.contenders.registry import contenders, find_contender
from bench.law.control.contact_controller import HYBRIDS

REFUSED = tomllib.loads(Path(__file__).with_name("refused.toml").read_text(encoding="utf-8"))
LAWS_IN_CONTACT = sorted((*HYBRIDS, *(f"impedance-{name}" for name in contenders("impedances"))))


@pytest.mark.parametrize(
    ("option", "word", "known"),
    [
        ("--suite", "defualt", sorted(SUITES)),
        ("--regulator", "rotation-matrx", sorted(contenders("regulators"))),
        ("--regulator", "linearized-euler/zyx-eular", sorted(contenders("representations"))),
        ("--representation", "zyx", sorted(contenders("representations"))),
        ("--task", "free-bodi", sorted((*tasks.names(), *tasks.contact_names()))),
        ("--arm", "ur5", tasks.arm_names()),
        ("--jacobian", "geometrik", sorted(contenders("jacobians"))),
        ("--inverse", "sovle", sorted(contenders("inverses"))),
        ("--regulator", "rotation-matrix@geometrik+solve", sorted(contenders("jacobians"))),
        ("--variation", "mass-1.3", sorted(tasks.variation_names())),
        ("--controller", "hybird-base+inverse", LAWS_IN_CONTACT),
        ("--controller", "hybrid/zyx-eular+inverse", sorted(contenders("representations"))),
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


@pytest.mark.parametrize(("words", "named"), REFUSED["usage"])
def test_usage_error_is_one_line_that_names_the_word(capsys, words, named):
    line = refused(capsys, *words.split())
    assert named in line
    assert any(cure in line for cure in ("try: ", "give one of these", "use one", " away)"))


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
    line = refused_run(capsys, finished, option, number, *["--dry-run"] * (number == "0"))
    assert line.startswith(f"error: {option} ")
    assert any(word in line for word in ("between", "must lie", "give a number", "give a whole number"))


@pytest.mark.parametrize(("words", "reason"), REFUSED["combinations"])
def test_what_does_not_go_together_is_refused_with_the_reason(capsys, finished, words, reason):
    assert reason in refused_run(capsys, finished, *words.split())


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
    cure = "(try: --regulator rotation-matrix --jacobian geometric --inverse solve)"
    assert cure in refused_run(capsys, finished, *words)


def test_same_word_twice_is_the_word_once():
    choices = [
        {"tasks": ("free-body",) * count, "start_sets": ("paper",) * count, "engines": ("native",) * count}
        for count in (1, 2)
    ]
    law = find_contender("rotation-matrix")
    once, twice = (planning.make(Request("quick", (law,), **choice)) for choice in choices)
    assert once == twice


@pytest.mark.parametrize("place", ["no/such/file.md", "folder/file.md/below"])
def test_summary_that_cannot_be_written_is_refused_before_anything_is_compared(capsys, monkeypatch, tmp_path, place):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "file.md").write_text("kept")
    reference = str(RESULTS / "reference")
    line = refused(capsys, "compare", reference, reference, "--summary", place)
    assert place in line
    assert "cannot be written" in line
    assert (tmp_path / "folder" / "file.md").read_text() == "kept"

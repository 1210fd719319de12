"""The command line where nothing is wrong: what each command prints of a small run, and what its help explains."""

import re

import pytest
import rich_click as click
from command_line import TINY, bench

import tasks
from bench import plan, store
from bench.cli import commands
from bench.discovery import all_contenders, known_metrics, known_regulators, known_representations
from bench.suites import SUITES

COMMANDS = {command.name: command for command in commands()}


@pytest.fixture(scope="module")
def tiny_run(tmp_path_factory):
    """Three episodes on the reference engine."""
    from bench.cli import main

    out = tmp_path_factory.mktemp("run") / "tiny"
    assert main(["run", *TINY, "--engine", "reference", "--out", str(out)]) == 0
    return out


# ----------------------------------------------------------------------------------------------- help


def test_commands_are_the_eight_of_the_design():
    assert set(COMMANDS) == {"list", "run", "show", "count", "time", "compare", "claims", "doctor"}


def test_help_names_every_command(capsys):
    said = bench(capsys, "--help")
    assert said.code == 0
    assert [name for name in COMMANDS if f" {name} " not in said.out] == []


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_a_command_explains_every_option(capsys, name):
    said = bench(capsys, name, "--help")
    shown = re.sub(r"[^\w./:;,'-]+", " ", said.out)
    assert said.code == 0
    for option in COMMANDS[name].params:
        if isinstance(option, click.Option):
            assert option.opts[0] in said.out
            assert option.help.endswith(".")
            assert " ".join(option.help.split()[:2]).strip("[]:;,.") in shown
        else:
            assert option.name.upper() in said.out


def test_version_is_the_one_installed(capsys):
    assert re.search(r"\d+\.\d+\.\d+", bench(capsys, "--version").out)


# ----------------------------------------------------------------------------------------------- list

KNOWN = {
    "regulators": known_regulators(),
    "representations": known_representations(),
    "metrics": known_metrics(),
    "tasks": tasks.names(),
    "starts": tasks.start_set_names(),
    "engines": plan.ENGINES,
    "suites": SUITES,
}


@pytest.mark.parametrize("kind", KNOWN)
def test_list_names_everything_of_a_kind_and_nothing_else(capsys, kind):
    said = bench(capsys, "list", kind)
    rows = [line.split()[0] for line in said.out.splitlines()[2:] if line.strip() and not line.startswith(" ")]
    assert said.code == 0
    assert sorted(rows) == sorted(KNOWN[kind])


@pytest.mark.parametrize("kind", KNOWN)
def test_list_takes_the_singular_too(capsys, kind):
    assert bench(capsys, "list", kind[:-1]).out == bench(capsys, "list", kind).out


def test_list_shows_units_in_brackets_and_formulas_as_they_are(capsys):
    said = bench(capsys, "list", "metrics")
    assert all(one.unit in said.out for one in known_metrics().values())


def test_list_without_a_kind_lists_every_kind(capsys):
    said = bench(capsys, "list")
    assert said.code == 0
    for kind, names in KNOWN.items():
        assert kind.capitalize().removesuffix("s") in said.out
        assert all(name in said.out for name in names)


# ------------------------------------------------------------------------------------------ run, show


def test_run_prints_its_plan_and_what_to_do_next(capsys, tmp_path):
    said = bench(capsys, "run", *TINY, "--engine", "reference", "--out", tmp_path / "run")
    assert (said.code, said.err) == (0, "")
    assert "suite quick: 3 episodes in 1 units" in said.out
    assert f"python -m bench show {tmp_path / 'run'}" in said.out.replace("\n", "")


def test_dry_run_counts_what_a_run_then_writes(capsys, tiny_run):
    said = bench(capsys, "run", *TINY, "--engine", "reference", "--dry-run")
    assert f"suite quick: {len(store.read(tiny_run, 'episodes'))} episodes" in said.out


@pytest.mark.parametrize("suite", SUITES)
def test_suite_runs_every_law_that_is_not_a_costing(capsys, suite):
    said = bench(capsys, "run", "--suite", suite, "--dry-run")
    laws = re.search(r"laws: (.*?)\n\S+: ", said.out, re.DOTALL)[1].replace("\n", " ").split(", ")
    assert laws == [one.name for one in all_contenders() if not one.regulator.costing_only]


def test_show_counts_what_did_not_settle_by_law_and_start_set(capsys, tiny_run):
    """A hundred ticks are too few to settle."""
    said = bench(capsys, "show", tiny_run)
    assert said.code == 0
    assert "suite quick, 3 episodes" in said.out
    assert re.search(r"law +paper\s+rotation-matrix +3/3\s", said.out)


def test_show_has_every_outcome_of_one_engine_and_set_when_asked(capsys, tiny_run):
    whole = bench(capsys, "show", tiny_run, "--outcomes")
    assert re.search(r"paper +rotation-matrix +3 ", whole.out)
    assert bench(capsys, "show", tiny_run, "--outcomes", "--engine", "reference", "--starts", "paper") == whole


def test_run_compared_with_itself_agrees(capsys, tiny_run):
    said = bench(capsys, "compare", tiny_run, tiny_run)
    assert said.code == 0
    assert "agrees with" in said.out


# --------------------------------------------------------------------------------------- count, doctor


def test_count_has_a_line_for_each_law_and_branch(capsys):
    said = bench(capsys, "count")
    rows = [line.split()[:2] for line in said.out.splitlines() if " typical " in line]
    assert said.code == 0
    assert [row[0] for row in rows] == [one.regulator.name for one in all_contenders()]


def test_count_of_one_law_by_stage_adds_up(capsys):
    said = bench(capsys, "count", "--regulator", "rotation-matrix", "--stages")
    assert "regulate" in said.out
    assert "linearized-euler" not in said.out


def test_doctor_says_what_it_checked(capsys):
    said = bench(capsys, "doctor")
    assert [line.split()[1] for line in said.out.splitlines()] == [
        "python",
        "versions",
        "compiler",
        "engines",
        "rendering",
        "results",
    ]
    assert all(line.startswith(("ok", "note")) or "Cure: " in line for line in said.out.splitlines())

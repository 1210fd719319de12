"""The command line where nothing is wrong: what each command prints of a small run, and what its help explains."""

import inspect
import re

import pytest
import rich_click as click
from support.command_line import TINY, bench, python

from bench.base import files
from bench.base.provenance import ROOT
from bench.cli import command_of, main
from bench.cli.listing import KINDS, describe_arm
from bench.experiments import plan as planning
from bench.experiments.request import Request
from bench.experiments.suites import SUITES
from bench.experiments.tables import store
from bench.law.contenders import combinations
from bench.law.contenders.registry import all_contenders
from tasks.errors import BadArm

LAWS = ("hybrid", "linearized-euler/zyx-euler", "rotation-matrix")
EULER = "hybrid/zyx-euler+inverse"
FOUND = (command_of(path, is_given=True) for path in (ROOT / "bench" / "cli").glob("*.py"))
COMMANDS = {command.name: command for command in FOUND if command}


@pytest.mark.parametrize("words", [(), ("--help",)])
def test_help_is_shown_without_a_command_and_names_every_one(capsys, words):
    said = bench(capsys, *words)
    assert (said.code, said.err) == (0, "")
    assert [name for name in COMMANDS if f" {name} " not in said.out] == []


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_a_command_explains_every_option_and_says_when_it_ends_with_1(capsys, name):
    said = bench(capsys, name, "--help")
    shown = re.sub(r"[^\w./:;,'-]+", " ", said.out)
    assert said.code == 0
    source = inspect.getsource(inspect.getmodule(COMMANDS[name].callback))
    assert ("Exit code 1: " in said.out) == bool(re.search(r"raise Exit\((1|code)\)", source))
    for option in COMMANDS[name].params:
        if isinstance(option, click.Option):
            assert option.opts[0] in said.out
            assert option.help.endswith(".")
            assert " ".join(option.help.split()[:2]).strip("[]:;,.") in shown
        else:
            assert option.name.upper() in said.out


def test_examples_of_the_help_are_words_that_the_commands_take(capsys):
    helps = [bench(capsys, *words, "--help").out for words in ((), *((name,) for name in COMMANDS))]
    lines = [line.split()[1:] for said in helps for line in said.splitlines() if line.startswith("   bench ")]
    assert len(lines) > 20
    for name, *words in lines:
        assert COMMANDS[name].make_context(name, words)
        assert len(" ".join((name, *words))) <= 60


def test_version_is_the_one_installed(capsys):
    assert re.search(r"\d+\.\d+\.\d+", bench(capsys, "--version").out)


@pytest.mark.parametrize("kind", KINDS)
def test_list_names_everything_of_a_kind_and_nothing_else_and_takes_the_singular_too(capsys, kind):
    said = bench(capsys, "list", kind)
    rows = [line.split()[0] for line in said.out.splitlines()[2:] if line.strip() and not line.startswith(" ")]
    assert said.code == 0
    assert sorted(rows) == sorted(KINDS[kind].find_all())
    if kind.endswith("s"):
        assert bench(capsys, "list", kind[:-1]) == said


def test_list_names_a_broken_arm_with_the_reason():
    reason = "arm 'bent': it has no site 'tool' (add one)"
    assert describe_arm(BadArm(reason)).title == f"cannot be used: {reason}"


def test_run_prints_its_plan_and_what_to_do_next_and_show_its_counts(capsys, tmp_path):
    """A hundred ticks are too few to settle."""
    words, out = ("run", *TINY, "--engine", "reference"), tmp_path / "run"
    said = bench(capsys, *words, "--out", out)
    assert (said.code, said.err) == (0, "")
    for text in (said.out, bench(capsys, *words, "--dry-run").out):
        assert "suite quick: 3 episodes in 1 unit\n" in text
    assert f"bench show {out}" in said.out.replace("\n", "")
    details = bench(capsys, "show", out, "--details")
    assert details.code == 0
    assert "suite quick, 3 episodes" in details.out
    assert re.search(r"law +paper\s+rotation-matrix +0/3\s", details.out)
    assert re.search(r"paper +rotation-matrix +3 ", bench(capsys, "show", out, "--outcomes").out)


@pytest.mark.parametrize("suite", SUITES)
def test_suite_runs_every_law_that_is_not_a_costing(capsys, suite):
    said = bench(capsys, "run", "--suite", suite, "--experiment", "free-body", "--dry-run")
    laws = re.search(r"laws: (.*?)\n(?:baselines|free-body)", said.out, re.DOTALL)[1].replace(",", " ").split()
    assert laws == [one.name for one in all_contenders() if not one.regulator.costing_only]


ON_ARM = ("run", "--arm", "ur5e", "--starts", "clear", "--count", "1", "--horizon", "0.1")
WHOLE = "rotation-matrix@geometric+solve"


@pytest.fixture(scope="module")
def arm_run(tmp_path_factory):
    """One start, two inverses, two plants, on the reference engine: four episodes of twenty ticks."""
    words = ("--regulator", "rotation-matrix", "--jacobian", "geometric", "--inverse", "solve")
    plants = ("--variation", "nominal", "--variation", "friction-5", "--engine", "reference", "--dt", "0.005")
    out = tmp_path_factory.mktemp("run") / "out"
    assert main([*ON_ARM, *words, "--inverse", "transpose", *plants, "--out", str(out)]) == 0
    return out


@pytest.mark.parametrize("suite", SUITES)
def test_whole_name_runs_what_its_parts_run(capsys, suite):
    apart = ("--regulator", "rotation-matrix", "--jacobian", "geometric", "--inverse", "solve")
    said = [bench(capsys, *ON_ARM, "--suite", suite, *words, "--dry-run") for words in (("--regulator", WHOLE), apart)]
    assert said[0] == said[1]
    assert "arm, native, ur5e: clear 1 (each of 1 contender, at most)" in said[0].out


def test_show_keeps_controllers_causes_and_variations_of_an_arm_apart(capsys, arm_run):
    said = bench(capsys, "show", arm_run, "arms")
    first, second = said.out.split("model errors")
    assert re.search(rf"\n{re.escape(WHOLE)} +0/1 +never +never +1 law", first)
    assert re.search(r"\nrotation-matrix@geometric\+transpose +0/1 ", first)
    assert re.search(rf"friction-5 *\n{re.escape(WHOLE)} +0/1  \d", second)
    assert "SO(3)" not in said.out


def test_show_of_one_controller_shows_it_alone(capsys, arm_run):
    said = bench(capsys, "show", arm_run, "--regulator", WHOLE)
    assert WHOLE in said.out
    assert "transpose" not in said.out
    whole = bench(capsys, "show", arm_run, "--details")
    assert bench(capsys, "show", arm_run, "--regulator", "rotation-matrix").out.strip() in whole.out


@pytest.mark.slow
def test_run_in_contact_has_its_rows_and_no_episodes(tmp_path):
    """Two controllers, three poses of one task in contact on one arm, 20 ticks a trial."""
    words = ["--controller", "hybrid-base+inverse", "--controller", "impedance-geometric", "--horizon", "0.02"]
    place = ["--task", "wrench-probe", "--arm", "ur5e", "--count", "3", "--out", str(tmp_path / "out")]
    assert main(["run", *place, *words]) == 0
    rows = store.read(tmp_path / "out", "compliance")
    assert set(zip(rows.controller[3:], rows.form[3:], strict=True)) == {("impedance-geometric", "")}
    assert list(zip(rows.controller[:3], rows.form[:3], strict=True)) == [("hybrid-base", "inverse")] * 3
    assert set(rows.outcome) == {"done"}
    assert len(store.read(tmp_path / "out", "episodes")) == 0
    assert files.read_json(tmp_path / "out" / "provenance.json")["trials"] == rows.trials.sum()


def test_count_has_a_line_for_each_law_and_branch(capsys):
    said = bench(capsys, "count", *(word for law in LAWS for word in ("--regulator", law)))
    rows = [line.split()[:2] for line in said.out.splitlines() if " typical " in line]
    assert said.code == 0
    assert [row[0] for row in rows] == [law.partition("/")[0] for law in LAWS]


def test_count_of_joints_alone_counts_the_quick_suites_controllers(capsys):
    said = bench(capsys, "count", "--joints", "6")
    rows = [line for line in said.out.splitlines() if " typical " in line]
    laws = [one for one in all_contenders() if not one.regulator.costing_only]
    planned = {unit.contender for unit in planning.make(Request("quick", tuple(laws), arms=("ur5e",))).of("arm")}
    assert len(rows) == len(planned - {one.name for one in combinations.baselines(6)})


def test_count_of_controllers_in_contact_has_their_stages(capsys):
    said = bench(capsys, "count", "--controller", "hybrid-base+inverse", "--controller", EULER, "--stages")
    flops = {
        name: {line.split()[2]: int(line.split()[-1]) for line in said.out.splitlines() if f"{name} " in line}
        for name in ("hybrid-base+inverse", EULER)
    }
    for each in flops.values():
        assert each["total"] == each["regulate"] + each["invert"]
    assert flops[EULER]["regulate"] > flops["hybrid-base+inverse"]["regulate"]
    assert flops[EULER]["invert"] == flops["hybrid-base+inverse"]["invert"]


@pytest.mark.slow
def test_doctor_says_what_it_checked(capsys):
    said = bench(capsys, "doctor")
    checked = ["python", "versions", "compiler", "engines", "arms", "contact", "rendering", "results"]
    assert [line.split()[1] for line in said.out.splitlines()] == checked
    assert all(line.startswith(("ok", "note")) or "Cure: " in line for line in said.out.splitlines())


def test_sign_that_the_encoding_lacks_is_spelled():
    assert "180 deg" in python("-m", "bench", "audit", "check", "--help", PYTHONIOENCODING="ascii")

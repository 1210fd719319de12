"""The help of every command shows its texts as they are written: no unit in brackets is taken for markup."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

import bench.cli
from bench.cli import command_of

BRACKETS = re.compile(r"\[[^\[\]]*\]")
EVERY_COMMAND = [
    command
    for path in sorted(Path(bench.cli.__file__).parent.glob("*.py"))
    if (command := command_of(path, is_given=True))
]


def unwrap(text: str) -> str:
    """Return a text on one line, without the frames of its panels."""
    return re.sub(r"[\s│]+", " ", text)


def render_help(command) -> str:
    """Return the help of a command as a terminal of 300 columns shows it, on one line."""
    shown = CliRunner().invoke(command, ["--help"], prog_name=f"bench {command.name}", env={"COLUMNS": "300"})
    assert shown.exit_code == 0, shown.output
    return unwrap(shown.output)


def list_texts(command) -> list[str]:
    """Return the help strings of a command: its own, its end, and those of its options and arguments."""
    options = [getattr(option, "help", None) for option in command.params]
    return [str(text) for text in (command.help, command.epilog, *options) if text]


@pytest.mark.parametrize("command", EVERY_COMMAND, ids=lambda command: command.name)
def test_help_shows_every_bracket_of_its_texts(command):
    shown = render_help(command)
    for text in list_texts(command):
        for bracket in BRACKETS.findall(unwrap(text)):
            assert bracket in shown, f"{bracket} of: {text}"


def test_units_of_the_bound_and_of_the_spin_are_shown():
    [advise] = [command for command in EVERY_COMMAND if command.name == "advise"]
    shown = render_help(advise)
    assert "Greatest command [rad/s^2]." in shown
    assert "Speed at the start [rad/s]." in shown


def test_some_help_has_brackets():
    with_brackets = [command.name for command in EVERY_COMMAND if BRACKETS.search(" ".join(list_texts(command)))]
    assert {"advise", "judge"} <= set(with_brackets)


OPTIONS = {name: groups for name, groups in bench.cli.GROUPS.items() if name != "bench"}


def test_every_command_is_in_one_group_and_the_ones_to_use_come_first():
    grouped = [name for names in bench.cli.GROUPS["bench"].values() for name in names]
    assert sorted(grouped) == sorted(command.name for command in EVERY_COMMAND)
    first = next(iter(bench.cli.GROUPS["bench"].values()))
    assert set(first) == {"advise", "audit", "export", "judge", "run", "show"}


@pytest.mark.parametrize("name", OPTIONS)
def test_every_option_of_a_grouped_command_is_in_one_group(name):
    [command] = [command for command in EVERY_COMMAND if command.name == name]
    grouped = [option for options in OPTIONS[name].values() for option in options]
    assert sorted(grouped) == sorted(["--help", *(option.opts[0] for option in command.params)])
    assert len(next(iter(OPTIONS[name].values()))) <= 8


def test_help_shows_the_commands_to_use_before_the_others(capsys):
    bench.cli.main(["--help"])
    shown = capsys.readouterr().out
    assert shown.index("Use it") < shown.index("Maintain and study")

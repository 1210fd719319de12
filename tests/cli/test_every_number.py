"""Every option of every command that takes a number refuses what is none, in one line, before anything is run."""

import importlib
import math
from pathlib import Path

import pytest
import rich_click as click
from support.command_line import refused

from bench import cli
from bench.cli import options

NONSENSE = ("nan", "-nan", "inf", "-inf", "1e400", "-1e400", "", "abc", "1e-320", "0x10", "9" * 30)
"""Words that stand for no number that a command can use; some options take one of them, see TAKEN."""

TAKEN = {("advise", "--bound"): ("inf",), ("advise", "--torque"): ("inf",)}
"""Command and option -> words that mean something there."""


def commands() -> dict[tuple[str, ...], click.Command]:
    """Return every command by its words, subcommands too."""
    found = {}
    for path in Path(cli.__file__).parent.glob("*.py"):
        module = importlib.import_module(f"{cli.__name__}.{path.stem}")
        command = getattr(module, "COMMAND", None)
        if command is not None:
            found[command.name,] = command
    for words, command in list(found.items()):
        if isinstance(command, click.Group):
            found |= {(*words, name): each for name, each in command.commands.items()}
    return found


def takes_number(option: click.Parameter) -> bool:
    """Tell whether an option converts its word to a number, by its type or by a function."""
    if not isinstance(option, click.Option) or option.is_flag:
        return False
    kinds = (
        options.NumberOption,
        click.types.FloatParamType,
        click.types.IntParamType,
        click.types.FuncParamType,
    )
    return isinstance(option.type, kinds)


NUMBERS = [
    (words, option)
    for words, command in sorted(commands().items())
    for option in command.params
    if takes_number(option)
]


def test_every_number_is_of_our_type_or_a_time():
    """FloatRange takes NaN, and FLOAT takes all that Python's float does."""
    others = [
        (*words, option.opts[0])
        for words, option in NUMBERS
        if not isinstance(option.type, options.NumberOption | click.types.FuncParamType)
    ]
    assert others == []
    named = {(words[0], option.opts[0]) for words, option in NUMBERS}
    assert {("run", "--kp"), ("judge", "--law-limit"), ("prove", "--workers"), ("map", "--spin")} <= named
    assert {("advise", name) for name in ("--kp", "--kv", "--bound", "--rate", "--stiffness")} <= named


@pytest.mark.parametrize(
    ("words", "option"), NUMBERS, ids=[f"{' '.join(words)} {option.opts[0]}" for words, option in NUMBERS]
)
def test_word_that_is_no_number_is_refused_in_one_line(words, option):
    """The command's function never runs: only its words are read."""
    name = option.opts[0]
    command = commands()[words]
    arguments = ["law" for one in command.params if isinstance(one, click.Argument) and one.required]
    for word in NONSENSE:
        if word in TAKEN.get((words[0], name), ()):
            continue
        if word == "1e-320" and (isinstance(option.type, click.types.FuncParamType) or option.type.low == 0.0):
            continue  # a time or a speed may be as small as one likes: it counts as none
        with pytest.raises(click.ClickException) as error:
            command.make_context(words[0], [*arguments, f"{name}={word}"])
        assert len(error.value.format_message().splitlines()) == 1


@pytest.mark.parametrize(
    ("words", "option"), NUMBERS, ids=[f"{' '.join(words)} {option.opts[0]}" for words, option in NUMBERS]
)
def test_default_and_the_example_of_the_message_are_taken(words, option):
    command = commands()[words]
    arguments = ["law" for one in command.params if isinstance(one, click.Argument) and one.required]
    example = (
        [f"{option.opts[0]}={option.type.example}"]
        if isinstance(option.type, options.NumberOption)
        else []
    )
    for given in ([], example):
        assert command.make_context(words[0], [*arguments, *given]) is not None


@pytest.mark.parametrize("word", ["nan", "0", "-1", "99999999999999999999"])
def test_workers_of_proofs_are_refused_as_those_of_runs(capsys, word):
    line = refused(capsys, "prove", "--workers", word)
    assert line.startswith(f"error: --workers '{word}': give a whole number from 1 to 256 (try: --workers ")


def test_message_names_what_was_given_what_is_allowed_and_the_cure(capsys):
    line = refused(capsys, "run", "--kp", "nan")
    assert line == "error: --kp 'nan': give a number from 1e-06 to 1e+06 (try: --kp 100)"


def test_number_takes_its_bounds_and_infinity_where_it_means_something():
    bound = options.NumberOption(0.0, 10.0, 1.0, is_open=True, infinite="no bound")
    assert bound.convert("10", None, None) == 10.0
    assert bound.convert("inf", None, None) == math.inf
    for word in ("0", "10.1", "-inf", "nan"):
        with pytest.raises(click.UsageError, match="more than 0 and at most 10, or inf for no bound"):
            bound.convert(word, None, None)

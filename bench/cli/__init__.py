"""The command line: `bench COMMAND`. One file a command, collected from this folder, imported only when it is given.

A mistake of the caller ends in one line on stderr and exit code 2, and touches no result; examples.toml has all codes.
"""

import ast
import importlib
import sys
import tomllib
from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.base.errors import BenchError, print_refusal
from bench.base.provenance import describe_project
from bench.cli.screen import examples

# No markup: it would take a unit in brackets, as [rad/s^2], for a tag and drop it.
click.rich_click.TEXT_MARKUP = None
click.rich_click.MAX_WIDTH = 110
click.rich_click.STYLE_OPTIONS_TABLE_PAD_EDGE = False

GROUPS = tomllib.loads(Path(__file__).with_name("groups.toml").read_text(encoding="utf-8"))
"""Command -> group -> its options; of `bench` itself, its commands."""


def list_groups(command: str, kind: str) -> Any:
    """Return the groups of a command, a list as rich-click takes it; kind: what is in them."""
    return [{"name": name, kind: words} for name, words in GROUPS[command].items()]


click.rich_click.COMMAND_GROUPS = {"bench": list_groups("bench", "commands")}
for _command in (word for word in GROUPS if word != "bench"):
    click.rich_click.OPTION_GROUPS[f"bench {_command}"] = list_groups(_command, "options")


@click.group(epilog=examples("bench"), context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(describe_project()["version"])
def bench() -> None:
    """Which orientation error should a Cartesian controller use, where does it fail, what does it cost per tick?

    Runs every orientation regulator on the same plant from the same starts, judges the outcome, counts the
    operations, and compares the results with the claims of Murphy (1988).
    """


def command_of(path: Path, is_given: bool) -> click.Command | None:
    """Return the constant COMMAND of a module, None if it has none; of one that is not given, only name and help."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and node.name == "COMMAND":
            if is_given:
                return importlib.import_module(f"{__name__}.{path.stem}").COMMAND
            return click.Command(FILES.get(path.stem, path.stem), help=ast.get_docstring(node))
    return None


FILES = {"listing": "list"}
"""Modules whose command has another name: one named `list` would hide Python's."""


def list_files(words: list[str]) -> list[Path]:
    """Return the modules that the words need: that of the command alone if they begin with one, else all of them.

    To read all of them takes a tenth of a second.
    """
    files = {FILES.get(path.stem, path.stem): path for path in Path(__file__).parent.glob("*.py")}
    commands = [name for names in GROUPS["bench"].values() for name in names]
    if words and words[0] in commands:
        return [files[words[0]]]
    return list(files.values())


RESUMED = "what was finished is kept, and the same command goes on from there"
UNWRITTEN = "nothing was written"
LOST = "this command keeps nothing of what was not finished, and starts from the beginning"
"""What becomes of the work when Ctrl-C ends a command: kept by unit, never written to a file, or written at its end."""

STOPPED = dict.fromkeys(("run", "map"), RESUMED)
STOPPED |= dict.fromkeys(("advise", "judge", "list", "show", "claims", "count", "doctor"), UNWRITTEN)


def main(words: list[str] | None = None) -> int:
    """Run one command; its exit code."""
    words = sys.argv[1:] if words is None else words
    given = next((word for word in words if not word.startswith("-")), "")
    try:
        for path in list_files(words):
            command = command_of(path, FILES.get(path.stem, path.stem) == given)
            if command is not None:
                bench.add_command(command)
        return bench.main(words or ["--help"], prog_name="bench", standalone_mode=False) or 0
    except Exit as stop:
        return stop.exit_code
    except click.ClickException as error:
        reason, context = error.format_message(), getattr(error, "ctx", None)
        where = context.command_path if context else "bench"
        return print_refusal(reason if "(try: " in reason else f"{reason} (try: {where} --help)")
    except (KeyboardInterrupt, click.Abort):
        print(f"stopped; {STOPPED.get(given, LOST)}", file=sys.stderr)
        return 130
    except Exception as error:
        from tasks.errors import TaskError  # with numpy, so only when there is a mistake

        if not isinstance(error, BenchError | TaskError):
            raise
        return print_refusal(str(error))

"""The command line: `python -m bench COMMAND`. One file a command, collected from this folder.

Every mistake of the caller ends in one line on stderr and exit code 2, and touches no result; examples.toml has all
codes.
"""

import importlib
import pkgutil
import sys
import tomllib

import rich_click as click
from click.exceptions import Exit

from bench.base.errors import BenchError
from bench.base.provenance import ROOT
from bench.cli.screen import examples
from tasks.errors import TaskError

click.rich_click.TEXT_MARKUP = "rich"
click.rich_click.MAX_WIDTH = 110
click.rich_click.STYLE_OPTIONS_TABLE_PAD_EDGE = False

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
"""The version of the checkout that runs, installed or not."""


@click.group(epilog=examples("bench"), context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(VERSION)
def bench() -> None:
    """Which orientation error should a Cartesian controller use, where does it fail, what does it cost per tick?

    Runs every orientation regulator on the same plant from the same starts, judges the outcome, counts the
    operations, and compares the results with the claims of Murphy (1988).
    """


def commands() -> list[click.Command]:
    """Return the constant COMMAND of every module in this folder."""
    modules = [importlib.import_module(f"{__name__}.{found.name}") for found in pkgutil.iter_modules(__path__)]
    return [module.COMMAND for module in modules if hasattr(module, "COMMAND")]


def main(words: list[str] | None = None) -> int:
    """Run one command; its exit code."""
    for command in commands():
        bench.add_command(command)
    words = sys.argv[1:] if words is None else words
    try:
        return bench.main(words or ["--help"], prog_name="python -m bench", standalone_mode=False) or 0
    except Exit as stop:
        return stop.exit_code
    except click.ClickException as error:
        reason = error.format_message()
        return _refused(reason if "(try: " in reason else f"{reason} (try: {_path(error)} --help)")
    except (BenchError, TaskError) as error:
        return _refused(str(error))
    except (KeyboardInterrupt, click.Abort):
        print("stopped; what was finished is kept, and the same command goes on from there", file=sys.stderr)
        return 130


def _refused(reason: str) -> int:
    """Say on one line what was wrong; the exit code of every mistake."""
    print(f"error: {' '.join(reason.split())}", file=sys.stderr)
    return 2


def _path(error: click.ClickException) -> str:
    """Return the command that the mistake was made with."""
    context = getattr(error, "ctx", None)
    return context.command_path if context else "python -m bench"

"""The command line of the audit, which needs NumPy alone: `orientation-audit COMMAND`, here `bench audit COMMAND`."""

import argparse
import importlib
import importlib.metadata
import json
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from bench.base.errors import BadFunction, BenchError, UnknownWord, print_refusal
from bench.base.signs import spell_where_needed

COMMANDS = {
    "check": ("check", "find the convention of an orientation error, and its faults"),
    "actions": ("actions.command", "find what the rotation of logged actions means, and whether it is as stated"),
}
"""Word of a command -> its module, with DESCRIPTION, EPILOG, add_arguments and run; and what it does."""
EPILOG = """\
For example: {prog} check my_file.py:my_error. Options and more examples: {prog} check --help.
Exit code 0: no fault. Exit code 1: a fault. Exit code 2: it could not be checked; one line says why and what to do."""


class Parser(argparse.ArgumentParser):
    """A parser that raises what is wrong, and takes no part of an option's name for it."""

    def __init__(self, **given: Any) -> None:
        super().__init__(formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False, **given)

    def error(self, message: str) -> NoReturn:
        """Raise it with the place that explains it."""
        raise BadFunction(f"{message} (try: {self.prog} --help)")


def run_command(words: Sequence[str], prog: str, version: str) -> int:
    """Run one command, `check` if the words begin with a function, and return its exit code: 0; 1 for a fault."""
    first = next(iter(words), "--help")
    if first not in (*COMMANDS, "-h", "--help", "--version"):
        if not re.search(r"[.:]|^-", first):
            raise UnknownWord("command", first, list(COMMANDS))
        words, first = ("check", *words), "check"
    parser = Parser(prog=prog, description="Check an orientation controller.", epilog=EPILOG.format(prog=prog))
    parser.add_argument("--version", action="version", version=version)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, (module, what) in COMMANDS.items():
        one = commands.add_parser(name, help=what)
        if name == first:  # of the others nothing is imported
            found = importlib.import_module(f"{__package__}.{module}")
            one.description, one.epilog = found.DESCRIPTION, found.EPILOG.format(prog=one.prog)
            found.add_arguments(one)
            one.add_argument("--json", type=Path, metavar="FILE", help="write the report to this file, for machines")
            one.set_defaults(run=found.run, options=re.findall(r"--[\w-]+", one.format_usage()))
    try:
        arguments, rest = parser.parse_known_args(words)
    except SystemExit:
        return 0  # it has printed the help or the version
    if rest:
        raise UnknownWord("argument", rest[0], arguments.options)
    code, text, report = arguments.run(arguments)
    print(text, end="")
    if file := arguments.json:
        try:
            file.write_text(json.dumps(report, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        except OSError as error:
            raise BadFunction(f"--json {file}: cannot be written ({error.strerror}); name another file") from error
    return int(code)


def main() -> int:
    """Run the installed command and return its exit code, with every mistake on one line."""
    spell_where_needed(sys.stdout, sys.stderr)
    try:
        return run_command(sys.argv[1:], "orientation-audit", importlib.metadata.version("orientation-audit"))
    except BenchError as error:
        return print_refusal(str(error))
    except KeyboardInterrupt:
        return 130

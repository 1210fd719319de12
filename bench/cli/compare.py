"""`compare`: two runs, or two revisions of the code, through the gates."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.base.errors import BadResults, BenchError
from bench.base.files import write_json
from bench.base.on_first_use import pd
from bench.base.provenance import read_provenance, rounded_on
from bench.cli import options
from bench.cli.judge import print_judgement
from bench.cli.progress import progress
from bench.cli.screen import console, examples, frame_table
from bench.regression.revisions import summary as words
from tasks.errors import TaskError


@click.command("compare", epilog=examples("compare"))
@click.argument("base", required=False)
@click.argument("head", required=False)
@options.law
@click.option("--no-timing", is_flag=True, help="Do not compare time.")
@click.option("--benchmarks", type=click.Path(path_type=Path), metavar="FOLDER", help="Keep base.json and head.json.")
@click.option("--summary", type=options.NEW_FILE, metavar="FILE", help="Markdown for a pull request.")
def COMMAND(summary: Path | None, **asked: Any) -> None:
    """Compare HEAD with BASE, each a results folder or a git revision: what got worse, by how much, how sure.

    HEAD defaults to the working tree. BASE defaults to the commit where HEAD left main (on main: the commit before;
    outside git: results/reference, with results/quick for HEAD).

    A regression is a worse outcome, a new equilibrium away from the goal, a smaller basin, a missing row or law, a
    later settling time, 25 % more effort or peak command, twice the change of the command at rest, more of any
    operation, or a slower tick. If the judge changed, only the changed columns are listed.

    A law of your own is compared with its file at BASE in the whole quick suite and judged on both sides; a fault that
    BASE does not have is a regression. The laws of the benchmark are compared in a part of the quick suite; `make gate`
    compares the whole. --benchmarks keeps files of pytest-benchmark. The summary is also added to
    $GITHUB_STEP_SUMMARY.
    """
    written = [Path(one) for one in (summary, os.environ.get("GITHUB_STEP_SUMMARY")) if one]
    before = {path: path.read_text(encoding="utf-8") if path.exists() else "" for path in written}

    def leave(text: str) -> None:
        for path, said in before.items():
            try:
                path.write_text(said + text, encoding="utf-8")
            except OSError as error:
                cure = "give a file in a folder that is there (try: --summary summary.md)"
                raise BadResults(f"{path}: cannot be written ({error.strerror}); {cure}") from error

    leave("### Not judged: the comparison did not come to its end\n")
    try:
        _compare(leave=leave, **asked)
    except (BenchError, TaskError, click.UsageError) as error:
        leave(f"### Not judged: {words.escape(str(error))}\n")
        raise


def _compare(
    base: str | None, head: str | None, laws: options.Files, no_timing: bool, benchmarks: Path | None,
    leave: Callable[[str], None],
) -> None:  # fmt: skip
    from bench.regression import rows
    from bench.regression.revisions import gates

    base, head, folders = _resolve_sides(base, head, laws)
    if folders:
        comparison = gates.compare_folders(*folders)
        differences = rows.compare(*folders)
    else:
        with progress("steps", "checking out") as steps:
            functions = gates.GateFunctions(rounds=0 if no_timing else gates.ROUNDS)
            comparison = gates.compare_revisions(base, head, laws, steps.now, functions=functions)
        folded = " (which: --summary FILE)"
        differences = [
            f"{one.verdict}: {one.says}{folded * bool(one.more)}" for one in comparison.findings
        ]
    if comparison.measures:
        console().print(frame_table(pd.DataFrame(comparison.measures), "Free body, ideal-rk4"))
        console().print()
    for line in (*differences, *(rows.describe_skipped(folders[0]) if folders else ())):
        console().print(line)
    for one in comparison.judgements:
        console().print()
        print_judgement(one)
    if comparison.times:
        console().print(
            frame_table(pd.DataFrame(words.tabulate_times(comparison.times)), "\nBenchmarks")
        )
    if benchmarks:
        for name, content in zip(("base", "head"), comparison.files, strict=False):
            write_json(benchmarks / f"{name}.json", content)
    leave(words.write_markdown(comparison))
    if folders:
        for folder in folders:
            made_on = rounded_on(read_provenance(folder)) or "an unknown machine"
            console().print(f"{folder} was made on: {made_on}")
        agree = f"{len(differences)} differences between {base} and {head}"
        console().print(agree if differences else f"{head} agrees with {base}")
    else:
        console().print(frame_table(pd.DataFrame(comparison.gates), "\nGates"))
        console().print(f"\n{words.write_headline(comparison)}")
    if differences if folders else comparison.regressions:
        raise Exit(1)


def _resolve_sides(base: str | None, head: str | None, laws: options.Files) -> tuple[str, str | None, list[Path]]:
    """Return base, head, and both as folders if they are; UsageError for one folder, or for a user's law in folders."""
    from bench.base.errors import Incompatible
    from bench.regression.revisions import commits

    if base is None:
        try:
            return commits.find_default_base(commits.find_repository(laws), head), None, []
        except Incompatible:
            if laws or (commits.ROOT / ".git").exists():
                raise
            base, head = str(options.REFERENCE), str(options.REFERENCE.with_name("quick"))
            return base, head, [Path(base), Path(head)]
    folders = [commits.is_folder(word) for word in (base, head) if word is not None]
    if not any(folders):
        return base, head, []
    if head is None or not all(folders):
        other = f"HEAD '{head}' is none" if head else "HEAD is not named"
        raise click.UsageError(f"'{base}' is a folder and {other}; compare two folders, or two revisions")
    if laws:
        raise click.UsageError("--law is judged in revisions; a folder's run has its laws already (leave --law away)")
    return base, head, [Path(base), Path(head)]

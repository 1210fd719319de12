"""The summary of a run, by its kind: the table first, for judging the claims may take half a minute."""

import os
from pathlib import Path

import numpy as np

from bench.base.provenance import read_provenance
from bench.cli.details import PARTS
from bench.cli.options import REFERENCE
from bench.cli.screen import counted, shown_path
from bench.cli.summary import failures, laws, paper, parts, today
from bench.cli.summary.lines import ABOUT, HEAD, print_lines, print_text
from bench.experiments.tables.run import MAIN_ENGINE, VARIABLE, Run
from bench.experiments.tables.statistics import Estimate, bootstrap, quantile
from bench.findings.answer import list_later_laws
from bench.findings.claims.adequacy import PAPERS, THREE
from bench.findings.claims.tables import settling_times
from bench.findings.replication import NEARLY_ALL
from bench.law.contenders.registry import simulated_contenders
from bench.law.inputs import Gains

FEW = 6
"""Laws that are shown beside each other, at most; the others are counted."""


def print_summary(folder: Path, is_named: bool) -> None:
    """Print it. `is_named`: whether the user named the folder, so that the commands below name it too."""
    run = Run(folder)
    run.table("episodes")  # refuses a run that has not finished
    is_whole = paper.holds_papers_laws(run)
    gains = find_gains(run)
    print_lines(describe_run(folder, run, gains), "")
    if is_whole:
        print_replication(run)
    else:
        print_some_laws(run, gains)
    print_parts(run, is_whole)
    for broken in failures.describe_broken(
        run.table("episodes"), run.table("robustness")
    ):
        print_text("Broken", broken, indent=ABOUT)
    print_lines("")
    if is_whole:
        paper.print_verdicts(run)
        today.print_today(gains)
    else:
        today.print_today_in_short(gains, parts.list_parts(run))
    print_next(folder, is_named, run, is_whole)


def find_gains(run: Run) -> Gains | None:
    """Return the gains of a run: of the free body, else of its arms, contact or perturbed laws if all have the same."""
    episodes = run.table("episodes")
    free = episodes[episodes["arm"] == ""]
    for rows in (
        free,
        episodes,
        run.table("compliance"),
        run.table("robustness"),
    ):
        if len(rows) and len(rows[["kp", "kv"]].drop_duplicates()) == 1:
            return Gains(float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0]))
    return None


def describe_run(folder: Path, run: Run, gains: Gains | None) -> str:
    """Return the first line: what it is, with which gains, how many episodes and how long they took."""
    found = read_provenance(folder, ("suite", "episodes", "wall_s"))
    episodes = sum(found.get(name, 0) for name in ("episodes", "trials", "troubled"))
    ran = laws.list_laws(run)
    head = (
        counted(len(ran), "law")
        if ran
        else ", ".join(parts.list_parts(run)).capitalize()
    )
    if paper.holds_papers_laws(run):
        head = "Murphy (1988), replicated"
    at = f"kp {gains.kp:g} /s2, kv {gains.kv:g} /s, " if gains else "several gains, "
    return f"{head:{HEAD + 6}} {at}{counted(episodes, 'episode')} in {_write_wall(found['wall_s'])}"


def _write_wall(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 60.0 else f"{seconds / 60.0:.1f} min"


def print_replication(run: Run) -> None:
    """Print the paper's three laws, and the later laws that matter; laws of the user's are among these."""
    papers = [laws.measure_law(run, law) for law in THREE]
    print_lines(laws.HEADS, *(line for row in papers for line in laws.format_row(row)))
    # What is advised may take seconds to find: the paper's laws are on the screen before.
    ran = laws.list_laws(run)
    yours = [law for law in ran if laws.attribute(law) == laws.YOURS]
    advised = list_later_laws()
    known = advised if advised else [law for law in ran if law not in (*PAPERS, *yours)]
    later = [law for law in dict.fromkeys([*yours, *known]) if law in ran][
        : max(FEW, len(yours))
    ]
    since = [laws.measure_law(run, law) for law in later]
    print_lines(*laws.format_groups(since))
    print_text("", *laws.describe_columns([*papers, *since], run), indent=0)


def print_some_laws(run: Run, gains: Gains | None) -> None:
    """Print the laws of a run beside each other, the user's own first, and how their times compare."""
    ran = laws.list_laws(run)
    if not ran:
        return
    ran.sort(key=lambda law: laws.attribute(law) != laws.YOURS)
    rows = [laws.measure_law(run, law) for law in ran[:FEW]]
    kp = gains.kp if gains else 1.0
    print_lines(
        laws.WITH_EFFORT,
        *(line for row in rows for line in laws.format_with_effort(row, kp)),
    )
    if len(ran) > FEW:
        print_lines(f"and {counted(len(ran) - FEW, 'law')} more")
    compared = [compare_pace(run, ran[0], law) for law in ran[1:FEW]]
    print_text(
        "", *filter(None, compared), *laws.describe_columns(rows, run), indent=0
    )
    print_text("", laws.UNITS_WITH_EFFORT, indent=0)


def compare_pace(run: Run, law: str, other: str) -> str:
    """Compare the times in which 99 % of the uniform starts settle that both laws ran; nothing if there is none."""
    rows = run.table("episodes", arm="", start_set="uniform", task="free-body")
    for engine in dict.fromkeys((MAIN_ENGINE, *rows["engine"].astype(str))):
        own, beside = (
            rows[
                (rows["engine"] == engine) & (rows["contender"].astype(str) == name)
            ].set_index("start_id")
            for name in (law, other)
        )
        shared = own.index.intersection(beside.index)
        if len(shared):
            ratio = _compare_times(
                settling_times(own.loc[shared]), settling_times(beside.loc[shared])
            )
            if not np.isfinite(ratio.value):
                return f"{law} beside {other}: 99 % do not settle with both."
            return (
                f"{law} takes {ratio.value:.2f} ({ratio.low:.2f}-{ratio.high:.2f}) times as long as {other} until 99 % "
                f"settle ({len(shared):,} equal starts)."
            )
    return ""


def _compare_times(own: np.ndarray, other: np.ndarray) -> Estimate:
    """Return the ratio of the times in which 99 % settle, by a paired bootstrap over the starts."""

    def ratio(drawn: np.ndarray, axis: int) -> np.ndarray:
        times = quantile(drawn, NEARLY_ALL, axis=-2)
        with np.errstate(invalid="ignore"):
            return times[..., 0] / times[..., 1]

    return bootstrap(np.stack([own, other], axis=1), ratio)


def print_parts(run: Run, is_whole: bool) -> None:
    """Print the paper's Jacobians and compliance where a run has them, else its arms and contact as they are."""
    present = parts.list_parts(run)
    jacobians = paper.compare_jacobians(run) if is_whole else []
    compliance = paper.compare_compliance(run) if is_whole else []
    if "arms" in present:
        most = parts.FEW if is_whole else parts.MANY
        print_lines(*(jacobians or parts.describe_arms(run, most)))
    if "contact" in present and compliance:
        print_text("compliance", *compliance, indent=ABOUT)
    elif "contact" in present:
        print_text("contact", *parts.describe_contact(run), indent=ABOUT)
    if "robustness" in present and not is_whole:
        print_text("perturbed", *parts.describe_robustness(run), indent=ABOUT)


def print_next(folder: Path, is_named: bool, run: Run, is_whole: bool) -> None:
    """Print where the run lies, what is not in it, and the commands that say more."""
    here = shown_path(folder)
    name = f" {here}" if is_named else ""
    found = read_provenance(folder, ("commit", "dirty", "cpu"))
    changed = " with changes" if found["dirty"] else ""
    commit = found["commit"][:10] or "none"
    print_text(
        "This run",
        f"{here}, commit {commit}{changed}, {found['cpu']}{list_absent(run)}",
        indent=ABOUT,
    )
    if not is_named and folder == REFERENCE and VARIABLE not in os.environ:
        came = "It came with the benchmark; results/latest has no finished run (try: make bench)."
        print_text("", came, indent=ABOUT)
    commands = [f"bench show{name} --details"]
    if is_whole:
        book = f"{VARIABLE}={here} make report" if is_named else "make report"
        commands += [f"bench claims{name}", book]
    print_text("More", "; ".join(commands), indent=ABOUT)


def list_absent(run: Run) -> str:
    """Name the parts and count the laws that are not in the run; nothing if all are."""
    episodes = run.table("episodes")
    present = parts.list_parts(run)
    absent = [part.replace("-", " ") for part in PARTS if part not in present]
    ran = {str(name).partition("@")[0] for name in episodes["contender"].unique()}
    known = [law.name for law in simulated_contenders()]
    missing = [law for law in known if law not in ran]
    if "free-body" in present and missing:
        absent.append(f"{len(missing)} of {counted(len(known), 'law')}")
    return f"; not in it: {', '.join(absent)}" if absent else ""

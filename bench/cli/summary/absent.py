"""What a run does not hold, in words, and what the answer lacks for it."""

from __future__ import annotations

from bench.cli.details import parts
from bench.cli.paragraphs import Paragraph, listed
from bench.cli.screen import counted
from bench.experiments.experiment import known_experiments
from bench.findings.claims import Results
from bench.law.contenders.registry import all_contenders


def undecided(results: Results) -> Paragraph:
    """In place of the answer, where the run has not what laws are compared by."""
    episodes = results.table("episodes")
    free_body = episodes[episodes["arm"] == ""]
    sets = free_body.groupby(free_body["contender"].astype(str))["start_set"].agg(set)
    has = {
        "law with uniform and half-turn starts on the free body": any({"uniform", "half-turn"} <= one for one in sets),
        "robustness episodes": len(results.table("robustness")) > 0,
        "operation counts": len(results.table("costs")) > 0,
    }
    lacking = [what for what, there in has.items() if not there]
    why = f"it has no {listed(lacking, 'and no')}" if lacking else "no law of it has all that laws are compared by"
    return Paragraph(
        "Which law",
        (f"This run cannot say: {why}. A whole suite can (try: python -m bench run --suite quick).",),
    )


def parts_in(results: Results) -> list[str]:
    """The parts of a run, as `show` names them, that have rows."""
    episodes = results.table("episodes")
    tables = {"contact": "compliance"} | {name: one.table.name for name, one in known_experiments().items()}
    has = {"free-body": (episodes["arm"] == "").any(), "arms": (episodes["arm"] != "").any()}
    return [part for part in parts() if (has[part] if part in has else len(results.table(tables[part])))]


def paragraphs(results: Results) -> list[Paragraph]:
    """The parts and the laws that are not in the run; nothing if all are."""
    episodes = results.table("episodes")
    present = parts_in(results)
    absent = [part.replace("-", " ") for part in parts() if part not in present]
    ran = {str(name).partition("@")[0] for name in episodes["contender"].unique()}
    laws = [one.name for one in all_contenders() if not one.regulator.costing_only]
    missing = [law for law in laws if law not in ran]
    if "free-body" in present and missing:
        absent.append(f"{len(missing)} of the benchmark's {counted(len(laws), 'law')}")
    return [Paragraph("Not in it", (f"Not in this run: {listed(absent)}.",))] if absent else []

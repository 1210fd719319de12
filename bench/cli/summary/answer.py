"""Which law to use, from the map of situations; robots that the map does not cover, and laws compared in the run."""

from bench.cli.paragraphs import Paragraph
from bench.findings.selection import regions
from bench.findings.selection.robots import list_elsewhere
from bench.findings.selection.run_rows import Compared
from bench.findings.selection.sensitivity import vary
from bench.findings.selection.unbeaten import SPOKEN, find_bounds
from bench.findings.selection.words import (
    compare,
    cost,
    describe_bounds,
    describe_law_of_ours,
    describe_price,
    describe_shares,
    list_faster_ours,
    percent,
    together,
)
from bench.law.attribution import describe_source
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS
from tasks.situation import KP, NOMINAL


def paragraphs(found: Compared | None) -> list[Paragraph]:
    """Return what the map advises, what else to use elsewhere, and how laws of ours and the user's compare."""
    default = regions.find_regions()[0]
    said = [
        Paragraph("Which law", _default(found, default)),
        Paragraph("Elsewhere", _elsewhere(default.law)),
    ]
    for law in list_faster_ours():
        said.append(
            Paragraph(
                "Ours",
                (f"{describe_law_of_ours(law)} {_compared(found, law, default.law)}",),
            )
        )
    own = [
        law
        for law in (found.laws if found else ())
        if found and found.tables.contenders[law].regulator.origin
    ]
    said += [
        Paragraph("Yours", (f"{law}: {_compared(found, law, default.law)}",))
        for law in own
    ]
    others = [
        one
        for one in vary()[1:]
        if one.law != default.law
        and one.words not in ("no memory", "a continuous command")
    ]
    rules = "; ".join(
        f"if {one.words}: {one.law} ({one.advised:.0%})" for one in others
    )
    text = (
        f"{rules[:1].upper()}{rules[1:]}."
        if rules
        else "Every other rule that was tried advises the same."
    )
    return [*said, Paragraph("Other rules", (text,))]


def _default(found: Compared | None, region: regions.Region) -> tuple[str, ...]:
    rows = regions.read_map()
    [row] = rows[
        (rows["situation"] == NOMINAL.word) & (rows["contender"] == region.law)
    ].to_dict("records")
    drawn = sum(map(regions.is_drawn, regions.decide_all()))
    priced = (
        f" A tick takes {cost(found.tables, region.law)}."
        if found and region.law in found.laws
        else ""
    )
    return (
        f"Use the law {region.law} ({_attributed(region.law)}) for a body that turns freely, in simulation. Of {drawn} "
        f"situations drawn at random it is advised in {percent(region.advised)}. "
        f"{describe_shares(region.law)}",
        f"If one number changes at a time, no law that meets the requirements is more than {percent(SPOKEN)} faster "
        f"at: {describe_bounds(find_bounds(region.law))}.",
        describe_price(region.law),
        f"In the map, at kp = {PAPERS_GAINS.kp:g} 1/s², kv = {PAPERS_GAINS.kv:g} 1/s 99 % of the starts settle within "
        f"{row['time'] / KP**0.5:.3f} s.{priced} Your own numbers: bench advise --help.",
    )


def _attributed(law: str) -> str:
    """Return whose a law is, and its works without what else its source says."""
    one = find_contender(law)
    return describe_source(one.attribution, one.regulator.source.split("; ")[0])


def _elsewhere(default: str) -> tuple[str, ...]:
    """Return the law for each other region, for robots beside those of the map, and without memory."""
    others = [
        f"{one.law} ({one.advised:.0%})"
        for one in regions.find_regions()[1:]
        if one.advised >= 0.05
    ]
    lines = (
        [f"In other situations: {together(others)}; bench advise says which."]
        if others
        else []
    )
    for one in list_elsewhere():
        tied = f", tied with {together(one.tied)}" if one.tied else ""
        lines.append(f"If {one.words}: {one.law}{tied}.")
    return tuple(lines)


def _compared(found: Compared | None, law: str, default: str) -> str:
    if found is None or not {law, default} <= set(found.laws):
        return f"This run cannot compare it with {default}."
    return f"In this run, {compare(found, law, default)}"

"""The page on other libraries: which functions are right, which are not and where, and Euler angles."""

from __future__ import annotations

import functools

import pandas as pd

from bench.findings.counts import OURS, counts
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from report.figures.libraries import answers, loops

EVERYWHERE = ["small", "drawn", "near", "at", "pole"]

TO_USE = Table("Library | From a matrix | From a quaternion")
FAULTS = Table("Function | But")
ERRORS = Table("Function | Convention | Verdict | Largest error | Dead at 180° | Settles | Away | Instead")
CONTROLLERS = Table("Controller | By | Convention | Verdict | Dead at 180° | Settles | Away")
AS_ANGLES = Table("Function | Drawn | Poles | Half turns | As an error")
VERSIONS = Table("Library | Version | Python | numpy")

TAKES = ("matrix", "quaternion")
COMMANDS = {"velocity": "ω", "acceleration": "u"}


@functools.cache
def lines() -> pd.DataFrame:
    """A line a function."""
    return answers.functions(answers.table())


def right(every: pd.DataFrame) -> pd.DataFrame:
    """The functions against which nothing is said, with their largest error anywhere."""
    kept = every[every["objections"].map(len).eq(0) & every["form"].ne(answers.ANGLES)]
    return kept.assign(largest=kept[EVERYWHERE].max(axis=1))


def faulty(every: pd.DataFrame) -> pd.DataFrame:
    """Those against which something is, angles apart."""
    return every[every["objections"].map(len).gt(0) & every["form"].ne(answers.ANGLES)]


def facts(_: Run) -> dict:
    """Every number and list of names that the text takes; ours are not counted among other libraries'."""
    rows, every = answers.table(), lines()
    others = every[(every["library"] != OURS) & (every["form"] != answers.ANGLES)]
    kinds = others["objections"].map(set)
    dead = others[kinds.map(lambda found: answers.ZERO in found) & (others["form"] != answers.SINE)]
    sheets = others[kinds.map(lambda found: answers.SHEET in found)]
    sines, angles = others[others["form"] == answers.SINE], every[every["form"] == answers.ANGLES]
    exact = angles["objections"].map(len) == 0
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    return {
        "libraries": counts()["libraries"].number,
        "functions": len(others),
        "right": len(right(others)),
        "count": power(answers.COUNT_RAD),
        "sines": len(sines),
        "sine_names": names(sines),
        "sine_error": power(sines[EVERYWHERE].to_numpy().max()),
        "dead": names(dead),
        "dead_else": power(dead[["small", "drawn", "near", "pole"]].to_numpy().max()) if len(dead) else "0",
        "sheets": len(sheets),
        "sheet_names": names(sheets),
        "digits": int(
            kinds.map(lambda found: bool(found & {answers.DIGITS, answers.MISALIGNED, answers.NO_NUMBER})).sum()
        ),
        "long_names": names(others[kinds.map(lambda found: found == {answers.LONG_WAY})]),
        "worst_right": power(right(others)["largest"].max()),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "undecided": power(answers.UNDECIDED_RAD),
        "least_astray": f"{100 * angles['misaligned'].min():.0f}",
        "angle_functions": len(angles),
        "angles_exact": int(exact.sum()),
        "angles_wrong": names(angles[~exact]),
        **loop_facts(),
    }


def loop_facts() -> dict:
    """What the text says of closed loops: how many are run, and how many of them stay at 180° or turn away."""
    lines = loops.responses()[loops.responses()["library"] != OURS]
    functions, run = (lines[lines["kind"] == kind] for kind in ("function", "controller"))
    dead = functions[functions["dead"] == functions["at_180"]]
    fixed = loops.verdicts()[loops.verdicts()["fixed"] != ""]
    return {
        "loops": len(functions),
        "controllers": len(run),
        "loops_dead": len(dead),
        "loops_away": int((functions["away"] > 0).sum()),
        "axes_180": int(functions["at_180"].min()),
        "replaced": int((loops.verdicts()["replacement"] != "").sum()),
        "fixed": len(fixed),
    }


def names(some: pd.DataFrame) -> str:
    """`library's function, function; library's ...` as words, or none."""
    by_library = some.groupby("library", sort=False)["function"].agg(lambda found: ", ".join(dict.fromkeys(found)))
    return "; ".join(f"{library}: {found}" for library, found in by_library.items()) or "none"


def tables(_: Run) -> dict:
    """What to use, what not, largest errors by set of turns [rad], angles, versions."""
    every = lines()
    is_angles = every["form"] == answers.ANGLES
    return {
        "tab_to_use": TO_USE(to_use(every)),
        "tab_faults": FAULTS((asked(one), "; ".join(one.objections.values())) for one in faulty(every).itertuples()),
        "tab_errors": ERRORS(in_closed_loop(every[~is_angles])),
        "tab_controllers": CONTROLLERS(controllers()),
        "tab_angles": AS_ANGLES(
            (asked(one), *map(power, (one.drawn, one.pole, max(one.near, one.at))), f"{one.off:.1f}")
            for one in every[is_angles].itertuples()
        ),
        "tab_versions": VERSIONS(
            (f"`{name}`", one["version"], one["python"], one["numpy"])
            for name, one in sorted(answers.origins().items())
            if name != OURS
        ),
    }


def in_closed_loop(every: pd.DataFrame) -> list[tuple]:
    """A row a function: what it means, what the audit finds, and what a body does that is driven by it."""
    both = every.merge(loops.verdicts(), on=["library", "function", "takes"]).merge(
        loops.responses()[loops.responses()["kind"] == "function"], on=["library", "function"]
    )
    return [
        (
            asked(one),
            one.convention,
            one.faults or loops.RIGHT,
            power(max(one.small, one.drawn, one.near, one.at)),
            loops.dead(one),
            loops.settling(one),
            loops.away(one),
            replaced(one.replacement),
        )
        for one in both.itertuples()
    ]


def controllers() -> list[tuple]:
    """A row a controller: those that are run, and those that are restated from their source."""
    return [
        (
            asked(one) if one.kind == "controller" else one.library,
            COMMANDS[one.command],
            one.convention or "Z-Y-X angles",
            loops.verdict(one) if one.kind == "controller" else one.faults or loops.RIGHT,
            loops.dead(one),
            loops.settling(one),
            loops.away(one),
        )
        for one in with_their_errors(loops.responses()).itertuples()
    ]


def with_their_errors(lines: pd.DataFrame) -> pd.DataFrame:
    """Controllers' lines, with what the check says of the errors that they take; of angles it is not asked: empty."""
    theirs = lines[lines["kind"] != "function"]
    said = loops.verdicts()[["library", "function", "takes", "convention", "faults", "replacement"]]
    angles = lines_of_angles().reindex(columns=said.columns, fill_value="")
    said = pd.concat([said, angles]).rename(columns={"function": "error"})
    return theirs.merge(said, on=["library", "error"], validate="many_to_one")


def lines_of_angles() -> pd.DataFrame:
    """A line a function that returns angles."""
    return lines()[lines()["form"] == answers.ANGLES]


def to_use(every: pd.DataFrame) -> list[tuple]:
    """A row a library: its functions that are right and give the rotation vector, by what they take."""
    kept = right(every)
    kept = kept[kept["form"] == answers.VECTOR]
    return [
        (f"`{library}`", *(_named(kept[(kept["library"] == library) & (kept["takes"] == what)]) for what in TAKES))
        for library in dict.fromkeys(every["library"])
        if library != OURS
    ]


def _named(own: pd.DataFrame) -> str:
    """Names as code, without what the column says already."""
    return "<br>".join(f"`{name.partition(', of a ')[0]}`" for name in own["function"]) or html.MISSING


def replaced(by: str) -> str:
    """A replacement as code, or that none is needed."""
    return f"`{by}`" if by else html.MISSING


def asked(one) -> str:
    """A line's library and function."""
    return f"{one.library} `{one.function}`"

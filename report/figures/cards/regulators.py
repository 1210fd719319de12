"""The laws: a line of a table each, and a card; nothing of it is typed here."""

import re
import tomllib
from pathlib import Path

import pandas as pd

from bench.experiments.tables.run import Run, shown_run
from bench.findings import why
from bench.findings.amounts import count_of
from bench.findings.claims.tables import share
from bench.findings.proofs.certificate import read_certificates
from bench.findings.selection.advice import list_unmapped
from bench.findings.selection.regions import find_regions, list_ours
from bench.findings.selection.unbeaten import (
    SPOKEN,
    compare_with_advised,
    find_price,
    measure_shares,
)
from bench.findings.selection.words import percent
from bench.law.contender import Contender
from bench.law.contenders import regulators
from bench.law.contenders.registry import contenders, contenders_of, papers_laws
from bench.law.kinds import Law
from report.figures.cards.card import (
    LawPage,
    SourceFile,
    docstring,
    make_card,
    make_page,
    say_property,
    set_words,
)
from report.figures.cards.constants import describe_constants
from report.figures.kit import families, html, laws, style

UNTRUSTED = (
    "Somebody else wrote this law. Its file came with these results, and we did not run it: this "
    "page has its results only. If you have read the file, `bench trust FILE` lets it run, and "
    "this page then describes the law."
)
LAWS = html.PageTable(
    "Law | Origin | Stability | Uniform starts from which the body settles | Name on the command line",
    {"Uniform starts from which the body settles": lambda share: f"{100 * share:.1f} %"},
)
TEXTS: dict[str, dict[str, str]]
TEXTS = tomllib.loads(Path(__file__).with_name("laws.toml").read_text(encoding="utf-8"))
"""Law -> about, limitations, limitations-COORDINATES where they differ, and memory if it differs from MEMORY."""

MEMORY = (
    "Reset the memory before the first control step, and after each pause of the control. If the goal "
    "changes, the law keeps its memory. If you also reset the memory when the goal jumps, the path "
    "becomes shorter, but the body does not settle sooner. Between two control steps, the measured "
    "orientation must turn by less than 180°. This condition is met if phi + 2 e < 180°, where phi is the "
    "angle by which the body turns between two control steps, and e is the angle between the "
    "measured and the true orientation."
)
COUNTED = ("flops", "sin", "cos", "atan2", "acos", "compare")
EXAMPLE = re.compile(r" Shown by |, as from |, as at | A law that uses ")
"""Find where a sentence begins to show a state, or to name a fault in the code of a law that is new."""


def in_order() -> list[Law]:
    """Return the paper's three regulators, its variants by name, the later ones by name, the user's own of the run."""
    first = [one.regulator for one in papers_laws()]
    others = [one for one in contenders("regulators").values() if one not in first]
    return [*first, *sorted(others, key=lambda one: (one.is_beyond_the_paper, one.name)), *shown_run().user_laws()]


def every_law() -> list[Contender]:
    """Return each law in each of its coordinates, the paper's own first; the run's own laws are among them."""
    every = []
    for law in in_order():
        every += sorted(
            contenders_of(law), key=lambda contender: contender.uses_nonpaper_coordinates
        )
    return every


def source(regulator: Law) -> SourceFile:
    """Return a law's own file."""
    name = f"{regulator.name.replace('-', '_')}.py"
    if regulator.origin:
        return SourceFile(Path(regulator.origin), f"laws/{name}")
    return SourceFile(
        Path(regulators.__path__[0]) / name, f"bench/law/contenders/regulators/{name}"
    )


def text_of(regulator: Law, coordinates: str = "") -> tuple[str, str]:
    """Return what the law is and where it fails: in the words of laws.toml, of a user's law in those of its file.

    coordinates: in which it acts; in some of them a law has limitations of its own.
    """
    if regulator.name in TEXTS and not regulator.origin:
        own = TEXTS[regulator.name]
        return own["about"], own.get(f"limitations-{coordinates}", own["limitations"])
    return (UNTRUSTED, "") if regulator.source == UNTRUSTED else docstring(source(regulator).file)


def describe_memory(regulator: Law) -> str:
    """Return when a law's memory is reset: in its own words of laws.toml, or in those of all laws with memory."""
    own = {} if regulator.origin else TEXTS.get(regulator.name, {})
    return own.get("memory", MEMORY)


def page(one: Contender, run: Run, live: str = "") -> LawPage:
    """Return the page of a law; live: the page on which laws run, from the site's root, or empty."""
    word, is_exported = one.on_free_body, not (one.regulator.origin or one.regulator.costing_only)
    title, exported = laws.title_of(one), word if is_exported else ""
    return make_page(families.anchor(word), title, card(one, run), source(one.regulator), exported, live)


def card(one: Contender, run: Run) -> str:
    """Return the card of one law: source, formula, words and costs."""
    title, episodes = laws.title_of(one), run.any_rows("episodes", contender=one.name, engine=engine_of(one.regulator))
    what, fails = text_of(one.regulator, one.representation.name if one.representation else "")
    found = run.any_rows("command-field", contender=one.name)
    # a law with memory stores its side of 180°, whatever is proved of it
    declared = "global with memory" if one.regulator.memory else one.regulator.property
    said = why.sentences(found, declared, stiffness=one.regulator.stiffness) if len(found) else []
    # without the states that show it, which `judge` prints
    command = " ".join(EXAMPLE.split(each.text)[0].rstrip(".") + "." for each in said)
    acts = one.representation.title if one.representation else "rotation matrix"
    acts = acts if acts.endswith("angles") else f"the {acts[:1].lower()}{acts[1:]}"
    fields = {
        "Limitations": set_words(fails),
        "Memory": set_words(describe_memory(one.regulator)) if one.regulator.memory else "",
        "Coordinates": f"The law computes its error from {acts}.",
        **({} if one.regulator.costing_only else say_property(one.regulator, except_goals(found))),
        "Measured": set_words(measured(episodes, one.regulator)),
        "Properties of the command": set_words(command),
        "Recommended": set_words(advised(one.name)),
        "Constants that are ours": set_words(describe_constants(one.name)),
    }
    look, costs = html.light_dark_css(style.look(one.name).colour), costs_of(one, run)
    shown = costs.to_html(index=False, classes="plain", border=0, formatters=[html.cell] * len(costs.columns))
    caption = '<p class="card-fact">Operations of one control step, by stage of the computation:</p>'
    costs_table = f'{caption}<div class="card-costs" tabindex="0">{shown}</div>'
    return make_card(one.regulator, title, (what, fields), look, costs_table, attribution=one.attribution)


def except_goals(field: pd.DataFrame) -> str:
    """Say at which goals a law in its coordinates does not have what is said of its stiffness; empty of most laws."""
    whats = dict(zip(field["finding"].astype(str), field["what"].astype(str), strict=True))
    if whats.get("goal") == "no-number":
        return "This does not hold for goals at a pole of the coordinates, for example for the goal R_d = I."
    if whats.get("stiffness") == "uneven-elsewhere":
        return "The law has exactly this stiffness and damping only for the goal R_d = I."
    return ""


def costs_of(one: Contender, run: Run) -> pd.DataFrame:
    """Operations of the typical branch: a row a stage, the stages that do nothing left out."""
    rows = run.any_rows("costs", contender=one.name, branch="typical").set_index("stage")
    numbers = rows[[name for name in COUNTED if name == "flops" or rows[name].any()]]
    return numbers[(numbers > 0).any(axis=1)].rename(columns={"compare": "comparisons"}).reset_index()


def engine_of(regulator: Law) -> str:
    """Return the engine of a card's episodes: the continuous plant, or MuJoCo for an actuator that only it has."""
    return "native" if regulator.in_engine else "ideal-rk4"


def measured(episodes: pd.DataFrame, regulator: Law) -> str:
    """How many of the uniform starts settled, and how fast."""
    uniform = episodes[episodes["start_set"] == "uniform"]
    if regulator.costing_only:
        return (
            "We only counted the operations of this law. We did not simulate this law, because up to rounding errors "
            "its command is the command of another law, which we simulated."
        )
    if uniform.empty:
        return "The law is not in this run."
    settled = uniform["outcome"] == "settled"
    found = share(settled)
    amount = count_of(int(settled.sum()), len(settled), "uniform starts")
    said = (
        f"The body settles from {amount}. Uniform starts are spread evenly over all orientations. The 95 % confidence "
        f"interval of the share of uniform starts from which the body settles is {100 * found.low:.1f} to "
        f"{100 * found.high:.1f} %."
    )
    times = uniform.loc[settled, "settling_time_s"]
    if times.empty:
        return said
    pace = f"The median settling time is {times.median():.2f} s, and the longest settling time is {times.max():.2f} s."
    return f"{said} {pace}"


def say_share(value: float) -> str:
    """Say in which share of the drawn situations something holds; none and a little are words."""
    if 0.0 < value < 0.005:
        return "less than 1 % of the situations"
    return f"{percent(value) if value else 'none'} of the situations"


def advised(law: str) -> str:
    """Return in which share of the drawn situations a law is advised, and in which no law of two sets is faster."""
    if law in list_unmapped():
        return "We have not simulated this law in the situations of the map yet."
    region = next((region for region in find_regions() if region.law == law), None)
    is_ours = law in list_ours()
    if region is None and not is_ours:
        return ""
    shares = measure_shares(law, tie=SPOKEN)
    drawn = (
        f"We drew {shares.qualified.of:,} situations at random. Each situation is a combination of gains, motors and "
        "disturbances. In each situation our rule (chapter 7) recommends one of the laws that meet the requirements "
        "of the rule."
    )
    beside = (
        f"In {say_share(shares.qualified.value)} this law meets the requirements of the rule, and no published or "
        f"adapted law that also meets these requirements is more than {percent(SPOKEN)} faster than this law. If we "
        "also compare this law with the published and adapted laws that do not meet these requirements, the share of "
        f"such situations is {percent(shares.all.value)}."
    )
    if is_ours:
        beats = say_share(compare_with_advised(law).value)
        return (
            f"{drawn} The rule does not recommend this law, because this law is ours, and the rule recommends only "
            f"published and adapted laws. This law is more than {percent(SPOKEN)} faster than the recommended law in "
            f"{beats}. {beside}"
        )
    if region is None:
        return f"{drawn} {beside}"
    price = find_price(law)
    costs = (
        "In the nominal situation (damping ratio 1, no command limit and no delay), the largest command of the law "
        f"is {price.peak:.1f} kp. If the damping ratio is 1, and kp is chosen such that this largest command is "
        f"p rad/s², the body settles from 99 % of the starts within {price.at_equal_peak:.1f}/√p seconds."
    )
    recommends = f"The rule recommends this law in {say_share(region.advised)}."
    return f"{drawn} {recommends} {beside} {costs}"


def facts(run: Run) -> dict:
    """Return every law as a line."""
    return {"laws": LAWS(line(one, run) for one in every_law())}


def line(one: Contender, run: Run) -> tuple:
    """Return a link to a law's card, whose it is, its property, if that is proved, what was measured, its word."""
    law, known = one.regulator, read_certificates().get(one.regulator.name)
    proved = "proved" if known and known["is_proved"] else "measured"
    stability = law.property if law.property == "none" else f"{law.property}, {proved}"
    uniform = run.any_rows("episodes", contender=one.name, engine=engine_of(one.regulator), start_set="uniform")
    return (
        families.link(one.name, laws.title_of(one)),
        one.attribution,
        html.MISSING if law.costing_only else html.no_break(html.escape_untrusted(stability)),
        (uniform["outcome"] == "settled").mean() if len(uniform) else None,
        f"`{one.name}`",
    )

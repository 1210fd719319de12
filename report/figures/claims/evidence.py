"""What decided each claim, sentences that no run decides, and errata."""

import html as escape
from collections.abc import Iterable, Sequence

from bench.base.files import read_json
from bench.experiments.tables.run import Run
from bench.findings import claims
from bench.findings.amounts import join_words
from bench.findings.claims import Verdict, at_gains
from bench.findings.claims.errata import ERRATA, UNTESTABLE, Erratum
from bench.findings.claims.verdict import MISPRINTS, Earlier
from report.figures.claims.places import read_places
from report.figures.kit import html
from report.figures.kit.law_names import call_laws
from report.figures.kit.offered import OFFERED_BYTES, SITE_DATA
from report.figures.kit.spelling import marked_up, prose, typeset

SENTENCES = html.PageTable(
    "Section of the paper | Sentence of the paper | Why no simulation can decide"
)
SLIPS = html.PageTable(
    "Error | Where in the paper | Printed words | Correction | How we checked this error"
)


STUDIES = {
    "timings": "the folder <code>results/timings</code> (made by <code>bench time</code>)",
    "maps": "the folder <code>results/maps</code> (made by <code>bench map</code>)",
}
"""Evidence that is in no table of a run, and what makes it."""


def facts(run: Run) -> dict:
    """Return the rules of all criteria, how steady verdicts are, what decided each claim, and the tables."""
    every = claims.judge_each(run)
    study = read_json(at_gains.STORED)
    return {
        "rule": typeset(claims.RULE),
        "n_computed": sum(one.check is not None for one in ERRATA),
        "n_read": sum(one.check is None for one in ERRATA),
        "misprints": typeset(" ".join(MISPRINTS.split())),
        "steady": at_gains.describe(study, study["reference"], [verdict.id for verdict in every]),
        "sections": html.Html("".join(section(verdict, run) for verdict in every)),
        "untestable": SENTENCES((one["section"], f"“{prose(one['quote'])}”", prose(one["why"])) for one in UNTESTABLE),
        "slips": SLIPS(map(describe_slip, sorted(ERRATA, key=lambda one: one.check is None))),
    }


def describe_slip(one: Erratum) -> tuple:
    """Return the row of a slip, with how it was checked just now; ValueError if the check no longer confirms it."""
    if one.check and not one.check():
        raise ValueError(f"erratum {one.id}: its check '{one.how}' does not confirm it (cure: mend it in errata.py)")
    checked = f"{'computed: ' if one.check else ''}{prose(one.how)}"
    return one.id, prose(one.where), f"“{prose(one.printed)}”", prose(one.right), checked


def section(one: Verdict, run: Run) -> str:
    """Return what decided a claim, folded under its sentence; a link to it opens it, for the anchor is inside."""
    claim = one.claim
    value = "" if claim.value == "none given" else f" (In this quotation, we test {claim.value}.)"
    quoted = f"“{claim.quote}”{value}" if claim.quote else claim.sentence
    rows = {
        "The paper says": f"{escape.escape(claim.place)}: {marked_up(quoted)}",
        "We measured": marked_up(one.measured),
        "What is true": marked_up(call_laws(one.correction)),
        "Evidence": marked_up(call_laws(str(one.evidence))) + draw_numbers(one.evidence.numbers, claim.id),
        "Shown in": "<br>".join(place.html for place in read_places().get(claim.id, ())),
        "Rows that decide": describe_rows(one, run),
        "Commands": describe_commands(one),
        "Criterion": marked_up(f"{claim.criterion} ({written(claim.written)}.)" if claim.written else claim.criterion),
        "Earlier criteria": _listed(map(describe_earlier, claim.earlier)),
        "The paper leaves open": marked_up(claim.open),
        "Possible meanings": _listed(f"Meaning {k}: {text}" for k, text in enumerate(claim.readings, 1)),
    }
    entries = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in rows.items() if text)
    head = f"<b>{claim.id}</b> <span>{marked_up(claim.sentence)}</span> {html.badge(str(one.word))}"
    return (
        f'<details class="claim-fold"><summary>{head}</summary><dl class="claim" id="{one.id.lower()}">{entries}</dl>'
        "</details>"
    )


def describe_earlier(old: Earlier) -> str:
    """Return a criterion that stood before, with its date and the word that it gave."""
    return f"{written(old.written)}: {old}"


def draw_numbers(numbers: Sequence[Sequence[str]], id: str) -> str:
    """Return the numbers of an evidence as a table; nothing where its sentence has them all."""
    if not numbers:
        return ""
    heads, *rows = numbers
    head = "".join(f'<th scope="col">{marked_up(text)}</th>' for text in heads)
    body = "".join(f"<tr>{''.join(f'<td>{marked_up(call_laws(text))}</td>' for text in row)}</tr>" for row in rows)
    table = f'<table class="plain evidence"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'
    # A box that scrolls must be reached by key.
    reached = f'tabindex="0" role="region" aria-label="Numbers of {id}"'
    return f'<div class="pst-scrollable-table-container numbers" {reached}>{table}</div>'


def describe_rows(one: Verdict, run: Run) -> str:
    """Return how many rows and states decide a claim, the files, and the lines of Python that choose the rows."""
    evidence = one.evidence
    if not evidence.rows:
        return ""
    files = [link_file(name, run) for name in evidence.tables if name not in STUDIES]
    files += [folder for name, folder in STUDIES.items() if name in evidence.tables]
    used = f"The verdict uses {html.number(evidence.rows)} rows of {join_words(files)}"
    others = '<a href="appendix-data.html#tab-files">List of all files</a>.'
    return f"{used}. {others}{list_conditions(evidence.chosen)}"


def link_file(table: str, run: Run) -> str:
    """Return a link to the file of a table; its name where the site does not offer it."""
    name = f"{table}.parquet"
    path = run.folder / name
    is_offered = path.is_file() and path.stat().st_size <= OFFERED_BYTES
    return f'<a href="{SITE_DATA}/{name}" download>{name}</a>' if is_offered else f"<code>{name}</code>"


def list_conditions(chosen: Iterable[tuple[str, str]]) -> str:
    """Return the lines of Python that choose the rows of a claim."""
    lines = []
    for table, condition in chosen:
        name = table.replace("-", "_")
        lines.append(f'{name} = pandas.read_parquet("{table}.parquet")')
        if condition:
            lines.append(f'{name}.query("{condition}")')
    return f"<pre>{escape.escape(chr(10).join(dict.fromkeys(lines)))}</pre>" if lines else ""


def describe_commands(one: Verdict) -> str:
    """Return the commands that make the rows of a claim again and judge it."""
    if one.claim.replay:
        return f"<code>{one.claim.replay}</code> ({HOW_TO_RUN})."
    stored = [name for name in one.evidence.tables if name not in STUDIES]
    made = "<code>make bench</code> makes the tables of results, and " if stored or not one.evidence.tables else ""
    return f"{made}<code>bench claims</code> judges the claim ({HOW_TO_RUN})."


HOW_TO_RUN = '<a href="docs-install.html">how to install</a>'


def written(when: str) -> str:
    """Return whence a criterion is, '2026-11-21 9072535', in words."""
    date, _, commit = when.partition(" ")
    return f"Criterion of {date}, commit {commit}"


def _listed(texts: Iterable[str]) -> str:
    items = "".join(f"<li>{marked_up(text)}</li>" for text in texts)
    return f"<ul>{items}</ul>" if items else ""

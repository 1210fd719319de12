"""The verdicts: a square and a row for each claim, in the order of the paper. All words are the claim's own."""

from collections import Counter
from collections.abc import Iterable

from bench.experiments.tables.run import Run
from bench.findings import claims
from bench.findings.amounts import join_words
from bench.findings.claims import Verdict, Word
from bench.findings.claims.verdict import verb_phrase
from report.figures.claims.places import read_places
from report.figures.kit import html
from report.figures.kit.law_names import call_laws
from report.figures.kit.spelling import prose

VERDICTS = html.PageTable(
    "Claim | What the paper states, in our words | Verdict | What we measured | Shown in"
)

LOOKS = {**html.VERDICTS, Word.DEPENDS: "depends", Word.READING: "reading"}
"""Verdict -> class of its square: no two verdicts look alike."""

LONGEST_CORRECTION = 330
"""Characters of what is true that a cell holds; what is longer is in the evidence, a table of several cases."""


def facts(run: Run) -> dict:
    """Return a square a claim, a row a claim, and how many claims there are."""
    verdicts = sorted(claims.judge_each(run), key=lambda verdict: verdict.claim.paper_order)
    return {
        "count": len(verdicts),
        "words": claims.format_tally(verdict.word for verdict in verdicts),
        "tiles": html.Html(draw_tiles(verdicts)),
        "verdicts": table(verdicts),
    }


def table(verdicts: Iterable[Verdict]) -> html.Markdown | None:
    """Return a row a claim: number and section, statement, verdicts, what was measured, and where it is shown."""
    return VERDICTS(map(describe, verdicts))


def describe(verdict: Verdict) -> tuple:
    """Return the row of a claim."""
    claim = verdict.claim
    first = "" if verdict.first == verdict.word else f"<br>(first verdict: {verdict.first})"
    measured, correction = prose(verdict.measured), prose(call_laws(verdict.correction))
    if correction and len(verdict.correction) <= LONGEST_CORRECTION:
        measured += f'<br><span class="what-is-true">{correction}</span>'
    return (
        f'<a href="#{claim.id.lower()}">{claim.id}</a> <span class="section">{claim.section}</span>',
        prose(claim.sentence),
        f"{html.badge(str(verdict.word))}{first}",
        measured,
        describe_places(claim.id),
    )


def describe_places(id: str) -> str:
    """Return links to what shows a claim; to its own evidence where nothing else does."""
    places = read_places().get(id, ())
    return ", ".join(place.markdown for place in places) or f'<a href="#{id.lower()}">its evidence</a>'


def draw_tiles(verdicts: list[Verdict]) -> str:
    """Return a square for each claim in the colour and pattern of its verdict, and a key with the counts."""
    counts = Counter(verdict.word for verdict in verdicts)
    present = [word for word in Word if counts[word]]
    tallies = {word: f"{counts[word]} {verb_phrase(word, counts[word])}" for word in present}
    said = join_words(tallies.values())
    squares = "".join(map(_square, verdicts))
    keys = "".join(
        f'<li><span class="tile {LOOKS[word]}" aria-hidden="true"></span>{tally}</li>'
        for word, tally in tallies.items()
    )
    name = f"{len(verdicts)} claims in the order of the paper: {said}"
    return f'<ol class="claim-tiles" aria-label="{name}">{squares}</ol><ul class="claim-keys">{keys}</ul>'


def _square(verdict: Verdict) -> str:
    id, look = verdict.claim.id, LOOKS[verdict.word]
    name = f"{id}: {verdict.word}"
    return f'<li><a class="tile {look}" href="#{id.lower()}" title="{name}" aria-label="{name}">{id[1:]}</a></li>'

"""The paper's claims as a run decides them, counted by verdict."""

from __future__ import annotations

from bench.cli.paragraphs import Paragraph
from bench.findings.claims import Results, all_claims
from bench.findings.claims.verdict import NoEvidence, Word, decide

PLURAL = {
    Word.HOLDS: "hold",
    Word.CORRECTED: "hold with a correction",
    Word.FAILS: "do not",
    Word.ANSWERED: "open in 1988 and answered since then",
}


def paragraph(results: Results) -> Paragraph:
    """How many hold, hold with a correction or do not, which do not, and how many the run says nothing about."""
    ids: dict[Word | None, list[str]] = {}
    for one in all_claims():
        ids.setdefault(_word(one, results), []).append(one.id)
    words = [word for word in Word if word in ids]
    if not words:
        return Paragraph("Claims", (f"This run decides none of the paper's {len(all_claims())} claims.",))
    of_all = f" of the paper's {len(all_claims())} claims"
    named = {Word.FAILS: f" ({', '.join(ids.get(Word.FAILS, ()))})"}
    counts = ", ".join(
        f"{len(ids[word])}{'' if place else of_all} {_verb(word, len(ids[word]))}{named.get(word, '')}"
        for place, word in enumerate(words)
    )
    unknown = len(ids.get(None, ()))
    rest = f"; {unknown} cannot be judged from this run" if unknown else ""
    return Paragraph("Claims", (f"{counts}{rest}.",))


def _verb(word: Word, number: int) -> str:
    return str(word) if number == 1 and word != Word.ANSWERED else PLURAL.get(word, word)


def _word(claim, results: Results) -> Word | None:
    try:
        return decide(claim, results).word
    except NoEvidence:
        return None

"""The tables of the README as the committed results give them; `python -m tests.support.readme` prints them."""

import re

from bench.base.files import read_json
from bench.experiments.tables.run import Run
from bench.findings.answer import find_answer
from bench.findings.claims import format_tally, judge_possible
from bench.findings.claims.at_gains import STORED
from bench.findings.conclusions import conclude
from bench.findings.selection.robots import RUN

CONCLUSIONS = {
    "rotation-matrix": "rotation matrix",
    "linearized-euler": "linearized Euler angles",
    "euler-jacobian": "Euler Jacobian",
    "compliance": "compliance",
}
"""The four conclusions that the README shows, and what it calls them."""

NEEDS = ("default", "weak-motors", "no-memory", "arm")
"""The rows of advice that the README shows, by name."""


def list_conclusions() -> list[str]:
    """Return a row of Markdown for each conclusion shown: his words, the verdict, the finding's first sentence."""
    conclusions = {conclusion.name: conclusion for conclusion in conclude(Run(RUN))}
    rows = []
    for name, title in CONCLUSIONS.items():
        conclusion = conclusions[name]
        first_sentence = re.match(r".*?\.(?= |$)", conclusion.finding)[0]
        # A bar would end the cell.
        finding = first_sentence.replace("|", r"\|")
        rows.append(f"| {title}: “{conclusion.short}” | {conclusion.verdict} | {finding} |")
    return rows


def count_claims() -> str:
    """Return the sentence that counts the verdicts on all claims.

    A claim that is newer than the study of other runs is not among them: who adds one leaves the README as it is.
    """
    studied = read_json(STORED)["reference"]
    verdicts, _ = judge_possible(Run(RUN))
    words = [verdict.word for verdict in verdicts if verdict.claim.id in studied]
    return f"Of his {len(words)} claims that can be checked, {format_tally(words)}."


def list_needs() -> list[str]:
    """Return a row of Markdown for each kind of controller shown: the law, why, and its price."""
    needs = {need.name: need for need in find_answer().needs}
    rows = []
    for name in NEEDS:
        need = needs[name]
        law = f"`{need.law}` ({need.attribution})"
        rows.append(f"| {need.controller} | {law} | {need.why} | {need.price} |")
    return rows


if __name__ == "__main__":
    print("\n".join([*list_conclusions(), "", count_claims(), "", *list_needs()]))

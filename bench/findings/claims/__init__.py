"""The paper's claims, from C01: each sentence with a criterion fixed before the results, and its verdict.

A module holds measurements alone, and says first of which claims; the TOML file of the same name holds their texts.
The claims of another paper stand in a package here (`PAPERS`): the same rules judge them, and no count of the claims of
Murphy has them.
`verdict` has what a claim is, and `tables` what judging functions read: rows of a run, and nothing else. What claims
ask beyond the suites' episodes is measured by the experiment `probes`.
"""

import functools
import importlib
import pkgutil
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from bench.base.errors import BadClaim, NoEvidence, NoTable
from bench.experiments.tables.run import MAIN_ENGINE, Run, shown_folder
from bench.findings.claims.tables import CHECK_ENGINES
from bench.findings.claims.verdict import Claim, Evidence, Verdict, Word, decide, verb_phrase

RULE = (
    f"Like the paper, we simulate in continuous time for all verdicts (engine {MAIN_ENGINE}). We "
    "also report simulations in which the command stays constant during each control period "
    f"(engines {' and '.join(CHECK_ENGINES)}). They change no verdict. A claim without data has no "
    "verdict."
)
"""What is common to all criteria."""


MURPHY = "murphy-1988"
PAPERS = {MURPHY: __name__, "lopez-slotine-2024": f"{__name__}.lopez_slotine_2024"}
"""A paper, and the package that holds its claims."""


@functools.cache
def all_claims(paper: str = MURPHY) -> tuple[Claim, ...]:
    """Return every claim of a paper, in the order of the ids; BadClaim: two of them have one id."""
    package = importlib.import_module(PAPERS[paper])
    files = [info.name for info in pkgutil.iter_modules(package.__path__) if not info.ispkg]
    modules = [importlib.import_module(f"{package.__name__}.{name}") for name in files]
    found: dict[str, Claim] = {}
    for module in modules:
        for one in vars(module).values():
            if not isinstance(one, Claim):
                continue
            if found.setdefault(one.id, one) is not one:
                raise BadClaim(f"{module.__file__}: another module has the claim {one.id}, too (take the next free id)")
    return tuple(found[id] for id in sorted(found))


def judge(id: str, run: Run) -> Verdict:
    """Return the verdict on one claim on a run's tables."""
    return decide(next(claim for paper in PAPERS for claim in all_claims(paper) if claim.id == id), run)


def judge_possible(run: Run, paper: str = MURPHY) -> tuple[list[Verdict], dict[str, str]]:
    """Return the verdict on every claim of a paper that a run decides, and for each other one what the run lacks."""
    decided, lacks = [], {}
    for one in all_claims(paper):
        try:
            decided.append(decide(one, run))
        except (NoEvidence, NoTable) as error:
            lacks[one.id] = str(error)
    return decided, lacks


def judge_each(run: Run, paper: str = MURPHY) -> list[Verdict]:
    """Return a verdict on every claim: 'not tested' where the run lacks what it needs, with what is lacking."""
    decided, lacks = judge_possible(run, paper)
    every = all_claims(paper)
    verdicts = {verdict.id: verdict for verdict in decided}
    for claim in every:
        if claim.id in lacks:
            evidence = Evidence(f"This run cannot decide the claim: {lacks[claim.id]}.", 0)
            verdicts[claim.id] = Verdict(claim, Word.UNTESTED, evidence)
    return [verdicts[claim.id] for claim in every]


def format_tally(words: Iterable[Word]) -> str:
    """Return how many claims have each word that some claim has: "20 hold, 1 does not hold"."""
    counts = Counter(words)
    return ", ".join(
        f"{counts[word]} {verb_phrase(word, counts[word])}" for word in Word if counts[word]
    )


def judge_all(folder: Path | None = None) -> list[Verdict]:
    """Return the verdict on every claim on the run in a folder, or on the one shown; NoEvidence: it lacks rows."""
    decided, lacks = judge_possible(Run(Path(folder) if folder else shown_folder()))
    if lacks:
        raise NoEvidence(next(iter(lacks.values())))
    return decided

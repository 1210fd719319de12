"""Lines on what to use today: by the answer, and for the gains of the run by the map of situations."""

from collections.abc import Iterator, Sequence

from bench.cli.summary.lines import ABOUT, print_text
from bench.findings.answer import Answer, Need, advise_gains, find_answer
from bench.law.inputs import PAPERS_GAINS, Gains

NAMES = {
    "weak-motors": "weak motors",
    "no-memory": "nothing stored",
    "continuous": "continuous command",
    "arm": "arm (goal never at 180 deg)",
    "velocity": "velocities",
    "position": "positions with a lag",
}
"""What the needs of the answer are called in a line."""

PRICED = ("weak-motors", "no-memory")
"""Needs whose law has a line of its own, with its price."""


def print_today(gains: Gains | None) -> None:
    """Print the law that is advised, and for other controllers; at other gains than the paper's, the law for these."""
    answer = find_answer()
    if not answer.is_tested:
        print_text(
            "Use today",
            "Not tested: there is no map of situations (results/situations).",
            indent=ABOUT,
        )
        return
    if gains and gains != PAPERS_GAINS:
        usual = f"other gains: {next(_list_sentences(answer))}"
        print_text("Use today", f"{advise_gains(gains)}", usual, indent=ABOUT)
        return
    print_text("Use today", *_list_sentences(answer), indent=ABOUT)


def print_today_in_short(gains: Gains | None, parts: Sequence[str]) -> None:
    """Print the law for a run of some laws or of arms in a line or two; of contact alone nothing is advised."""
    if "free-body" in parts or "robustness" in parts:
        print_text("Use today", advise_gains(gains or PAPERS_GAINS), indent=ABOUT)
    elif "arms" in parts:
        needs = {need.name: need for need in find_answer().needs}
        said = [f"{NAMES['arm']}: {_name_law(needs['arm'])} {needs['arm'].price}"]
        print_text(
            "Use today",
            *said,
            f"any start: {_name_law(needs['default'])}",
            indent=ABOUT,
        )


def _list_sentences(answer: Answer) -> Iterator[str]:
    needs = {need.name: need for need in answer.needs}
    yield f"{answer.law} ({answer.attribution}) {needs['default'].price}"
    for name in PRICED:
        if name in needs:
            # Its time beside the default's is in README and book: here a line is saved.
            price = needs[name].price.split(" and takes, if not limited,")[0]
            yield f"{NAMES[name]}: {_name_law(needs[name])} {price}"
    others: dict[str, list[str]] = {}
    for need in answer.needs:
        if need.name in NAMES and need.name not in PRICED:
            others.setdefault(_name_law(need), []).append(NAMES[need.name])
    yield "; ".join(f"{' or '.join(names)}: {law}" for law, names in others.items())


def _name_law(need: Need) -> str:
    return (
        f"{need.law} ({need.attribution})" if need.law != need.attribution else need.law
    )

"""`prove`: theorems about laws, from their source."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import rich_click as click
from click.exceptions import Exit

from bench.base.errors import MissingTool
from bench.base.files import write_json
from bench.base.on_first_use import pd
from bench.base.provenance import describe
from bench.cli import options
from bench.cli.progress import progress
from bench.cli.screen import console, examples, frame_table

SECONDS = options.NumberOption(0.1, 1e5, 30)
"""A question that takes a day is not answered; a tenth of a second is no time to answer one."""


@click.command("prove", epilog=examples("prove"))
@click.argument("laws", nargs=-1)
@options.workers("Laws at a time.")
@options.valued("--lemma-limit", 30.0, "Time limit of one question to Z3 [s].", type=SECONDS)
@options.valued("--law-limit", 150.0, "Time limit of one law [s].", type=SECONDS)
@click.option("--out", type=options.NEW_FILE, help="Write what is proved to this file, as JSON.")
def COMMAND(laws: tuple[str, ...], workers: int, lemma_limit: float, law_limit: float, out: Path | None) -> None:
    """Prove what laws' files declare of them, from the source (default: all that are global or almost global).

    LAWS are names of laws, or files of yours with a constant REGULATOR, which run in processes of their own.

    The source is called with symbols in place of numbers. Algebra and Z3 then decide for all orientations, rates
    and gains whether every root and division is defined, whether a Lyapunov function decreases, where it does not,
    and when a law with memory changes its side, from its first memory on. Intervals (Arb) bound the longest settling
    time from rest at the paper's gains.

    Each law is "proved"; "refuted", with a state where a lemma is false and from which an episode fails; or "not
    proved", with the lemma. What is proved is about continuous time: the exact state, no bound of the command, no
    delay, the inertia as modelled.
    """
    try:
        from bench.findings.proofs import certificate, sampled
    except ImportError as error:
        raise MissingTool(f"{error.name} is not installed, which proofs need (try: make prove)") from error
    provable = {law.name: law for law in certificate.list_laws()}
    chosen = [provable.get(word) or options.find_law(word) for word in laws] or list(provable.values())
    certificates = []
    with progress("laws", "proving") as steps, ThreadPoolExecutor(workers) as pool:
        for made in pool.map(lambda law: certificate.certify_apart(law, lemma_limit, law_limit), chosen):
            certificates.append(made)
            steps.now(made["law"], len(certificates), len(chosen))
    loops = [] if laws else [lemma._asdict() for lemma in sampled.prove_loops()]
    console().print(frame_table(pd.DataFrame([summarize(made) for made in certificates]), "What is proved"))
    for made in certificates:
        for text in list_faults(made):
            console().print(f"{made['law']}: {text}")
    console().print(f"A property is proved {certificate.SCOPE}.")
    console().print(
        "sampled: episodes that settle at the paper's gains, of the starts tried, with the command held for "
        f"{1e3 * certificate.SAMPLED_S:g} ms. That is measured, not proved."
    )
    for text in list_cited(certificates):
        console().print(f"Not checked by a program: {text}")
    if loops:
        proved = sum(lemma["is_proved"] for lemma in loops)
        console().print(f"Loops that are held between ticks: {proved} of {len(loops)} limits of stability proved.")
    if out:
        write_json(out, {"laws": certificates, "loops": loops, **describe()})
    if not all(made["is_proved"] for made in (*certificates, *loops)):
        raise Exit(1)


def summarize(made: dict[str, Any]) -> dict[str, Any]:
    """Return a certificate as a line of a table."""
    upper, sampled = (made["settling"] or {}).get("upper"), made["sampled"]
    return {
        "law": made["law"],
        "declared": made["declared"],
        "verdict": made["verdict"],
        "lemmas": f"{sum(lemma['is_proved'] for lemma in made['lemmas'])}/{len(made['lemmas'])}",
        "seconds": round(made["seconds"], 1),
        "settles_by_s": upper and round(upper, 4),
        "sampled": f"{sampled['settled']}/{sampled['starts']}" if sampled else "not tested",
    }


def list_faults(made: dict[str, Any]) -> list[str]:
    """Return what keeps a certificate from being one: the verdict's reason, lemmas, and where an episode shows it."""
    if made["is_proved"]:
        return []
    texts = [f"{made['verdict']}: {made['why']}"]
    for lemma in made["lemmas"]:
        if lemma["is_proved"]:
            texts.append(f"  proved: {lemma['statement']}")
        elif not made["why"].startswith(lemma["statement"]):
            texts.append(f"  not proved: {lemma['statement']}{lemma['note'] and ': ' + lemma['note']}")
    state = made["counterexample"]
    if state:
        place, rates = (", ".join(f"{number:.6g}" for number in state[name]) for name in ("quat_wxyz", "omega"))
        shown = f"counterexample: quaternion ({place}), omega ({rates}) rad/s, kp {state['kp']:g}, kv {state['kv']:g}"
        if state["path_ratio"] is not None:
            shown += (
                f"; an episode from there ends {state['outcome']} after {state['path_ratio']:.3g} times the shortest "
                "path"
            )
        texts.append(shown)
    return texts


def list_cited(certificates: list[dict[str, Any]]) -> list[str]:
    """Return what the certificates cite, each once."""
    return list(dict.fromkeys(text for made in certificates if made["is_proved"] for text in made["cited"]))

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


@click.command("prove", epilog=examples("prove"))
@click.argument("laws", nargs=-1)
@options.workers("Laws at a time.")
@click.option("--out", type=options.NEW_FILE, help="Write what is proved to this file, as JSON.")
def COMMAND(laws: tuple[str, ...], workers: int, out: Path | None) -> None:
    """Prove what laws' files declare of them, from the source (default: all that are global or almost global).

    LAWS are names of laws, or files of yours with a constant REGULATOR, which run in processes of their own.

    The source is called with symbols in place of numbers. Algebra and Z3 then prove for all orientations, rates
    and gains that a Lyapunov function decreases, where it does not, and when a law with memory changes its
    side; intervals (Arb) bound the longest settling time from rest at the paper's gains. A false lemma is shown
    with a state, and how an episode from there ends.
    """
    try:
        from bench.findings.proofs import certificate, sampled
    except ImportError as error:
        raise MissingTool(f"{error.name} is not installed, which proofs need (try: make prove)") from error
    provable = {one.name: one for one in certificate.list_laws()}
    chosen = [provable.get(word) or options.find_law(word) for word in laws] or list(provable.values())
    certificates = []
    with progress("laws", "proving") as steps, ThreadPoolExecutor(workers) as pool:
        for one in pool.map(certificate.certify_apart, chosen):
            certificates.append(one)
            steps.now(one["law"], len(certificates), len(chosen))
    loops = [] if laws else [one._asdict() for one in sampled.prove_loops()]
    console().print(frame_table(pd.DataFrame([summarize(one) for one in certificates]), "What is proved"))
    for one in certificates:
        for text in list_faults(one):
            console().print(f"{one['law']}: {text}")
    if loops:
        proved = sum(one["is_proved"] for one in loops)
        console().print(f"Loops that are held between ticks: {proved} of {len(loops)} limits of stability proved.")
    if out:
        write_json(out, {"laws": certificates, "loops": loops, **describe()})
    if not all(one["is_proved"] for one in (*certificates, *loops)):
        raise Exit(1)


def summarize(one: dict[str, Any]) -> dict[str, Any]:
    """Return a certificate as a line of a table."""
    upper = (one.get("settling") or {}).get("upper")
    return {
        **{"law": one["law"], "declared": one["declared"], "proved": "yes" if one["is_proved"] else "no"},
        **{"theorem": one["theorem"] or "none fits", "lemmas": len(one.get("lemmas", ()))},
        **{"seconds": round(one.get("seconds", 0.0), 1), "settles_by_s": upper and round(upper, 4)},
        "away_from_goal": one.get("equilibria", ""),
    }


def list_faults(one: dict[str, Any]) -> list[str]:
    """Return what keeps a certificate from being one: false lemmas, and where an episode shows it."""
    said = [f"not proved: {lemma['statement']}" for lemma in one.get("lemmas", ()) if not lemma["is_proved"]]
    if one["theorem"] and not said and not one["is_proved"]:
        said.append(f"its file declares '{one['declared']}', and what is proved is '{one['stands']}'")
    if found := one.get("counterexample"):
        place, rates = (", ".join(f"{one:.3g}" for one in found[name]) for name in ("quat_wxyz", "omega"))
        said.append(
            f"counterexample: quaternion ({place}), omega ({rates}) rad/s; an episode from there ends "
            f"{found['outcome']} after {found['path_ratio']:.3g} times the shortest path"
        )
    return said

"""What is proved of one law, in a process of its own: for `bench prove`, and for results/proofs/proofs.json."""

import sys
from pathlib import Path
from typing import Any

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.law.contenders.law_file import load_law
from bench.law.contenders.law_process import answer, ask
from bench.law.contenders.registry import contenders, contenders_of
from bench.law.kinds import Law

STORED = RESULTS / "proofs" / "proofs.json"
LIMIT_S, WAITS_S = 240.0, 600.0
"""Seconds of processor time for one law, several times what the slowest takes, and on the wall."""
WITH_TIME = "spring-and-damper"
"""The theorem whose V bounds the time after the last crossing of the band."""


def list_laws() -> list[Law]:
    """Return the laws whose files call them global or almost global: regulators, laws with a state, baselines."""
    every = [law for kind in ("regulators", "compensators", "baselines") for law in contenders(kind).values()]
    return [law for law in every if law.property.startswith(("almost global", "global"))]


def read_certificates() -> dict[str, dict[str, Any]]:
    """Return what results/proofs keeps: law -> its certificate."""
    return {one["law"]: one for one in read_json(STORED)["laws"]} if STORED.is_file() else {}


def certify_apart(law: Law) -> dict[str, Any]:
    """Return the certificate of a law, made in a process of its own; BadLaw: it ends that, or does not return."""
    asked = {"name": law.name, "text": law.text, "origin": law.origin}
    return next(ask(__name__, asked, WAITS_S, law.origin or law.name))


def certify(law: Law) -> dict[str, Any]:
    """Return what is proved of a law, as JSON has it.

    is_proved: whether all lemmas hold and prove the property that its file declares. settling: bounds of the settling
    time from rest, or why there are none. counterexample: a state where the first false lemma is false, and how an
    episode from there ends.
    """
    from bench.findings.proofs import settling_time
    from bench.findings.proofs.theorem import DoesNotFit, prove

    proof, settling = prove(law), {}
    if proof is None:
        return {"law": law.name, "declared": law.property, "is_proved": False, "theorem": None}
    if proof.is_proved() and proof.theorem == WITH_TIME:
        try:
            settling = settling_time.bound(law)._asdict()
        except DoesNotFit as reason:
            settling = {"reason": str(reason)}
    false = next((one for one in proof.lemmas if one.counterexample), None)
    return {
        "law": law.name,
        "declared": law.property,
        **proof._asdict(),
        "lemmas": [one._asdict() for one in proof.lemmas],
        "is_proved": proof.is_proved() and proof.stands == law.property,
        "settling": settling,
        "counterexample": replay(law, false.counterexample) if false and false.counterexample else None,
    }


def replay(law: Law, state: dict[str, float]) -> dict[str, Any]:
    """Return a state, and how an episode of the law ends that begins there."""
    from bench.engines.episode import FIRST_METRIC, OUTCOME, Settings
    from bench.engines.metrics.registry import metrics_of
    from bench.engines.simulate import CONTINUOUS, run
    from bench.law.inputs import PAPERS_GAINS
    from tasks.base import Start
    from tasks.rules import RULES, ticks
    from tasks.verdict import OUTCOMES

    w, x, y, z = (state[name] for name in ("w", "x", "y", "z"))
    omega = state["omega_x"], state["omega_y"], state["omega_z"]
    begun = law if law.memory is None else law._replace(memory=(w, x, y, z))
    dt_s, metrics = 1e-3, metrics_of(on_arm=False)
    settings = Settings(PAPERS_GAINS, dt_s, ticks(5.0, dt_s), RULES.hold_ticks(dt_s))
    start = Start("counterexample", (w, -x, -y, -z), omega)
    row = run(CONTINUOUS, contenders_of(begun)[0], "free-body", [start], settings, metrics)[0]
    measured = {one.column: float(value) for one, value in zip(metrics, row[FIRST_METRIC:], strict=False)}
    kept = {"quat_wxyz": start.quat_wxyz, "omega": omega, "outcome": OUTCOMES[int(row[OUTCOME])]}
    return kept | {"path_ratio": measured["path_ratio"]}


def certify_asked(asked: dict, path: Path | None) -> dict[str, Any]:
    """Return the certificate of the law that is named, or whose text is given."""
    ours = {one.name: one for one in list_laws()} | contenders("regulators")
    return certify(load_law(path, asked["text"].encode()) if path else ours[asked["name"]])


if __name__ == "__main__":
    answer(int(sys.argv[1]), LIMIT_S, certify_asked)

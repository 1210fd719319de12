"""What is proved of one law, in a process of its own: for `bench prove`, and for results/proofs/proofs.json."""

import json
from pathlib import Path
from typing import Any

from bench.base.errors import BadLaw
from bench.base.files import read_json
from bench.base.isolated import TimeLimits
from bench.experiments.tables.schema import RESULTS
from bench.findings.amounts import count_of
from bench.law.contenders.law_file import load_law
from bench.law.contenders.law_process import answer, ask
from bench.law.contenders.registry import contenders, contenders_of
from bench.law.kinds import HasLaw, Law

STORED = RESULTS / "proofs" / "proofs.json"
LEMMA_S, LAW_S = 30.0, 150.0
"""Seconds on the wall for one question to Z3; of processor time for one law, of which the slowest of ours takes 20."""
HARD_S = 1200.0
"""Seconds of processor time after which the system ends a process that does not look at its clock."""
WAITS = 8
"""How many times the time for one law it may take on the wall, where other programs run."""
DRAWN = "drawn states"
"""Method of a lemma that is checked and not proved: a law's numbers are those of its trace."""
PROVED, REFUTED, NOT_PROVED = "proved", "refuted", "not proved"
SCOPE = (
    "in continuous time, with exact arithmetic, an exactly known state, an exactly known inertia, motors without "
    "a limit, and no delay"
)
"""What a property is about, wherever it is said to be proved."""
WITH_TIME = "spring-and-damper"
"""The theorem whose V bounds the time after the last crossing of the band."""


def list_laws() -> list[Law | HasLaw]:
    """Return the laws whose files call them global or almost global: regulators, laws with a state, baselines."""
    kinds = ("regulators", "compensators", "baselines")
    laws = [law for kind in kinds for law in contenders(kind).values()]
    return [law for law in laws if law.property.startswith(("almost global", "global"))]


def read_certificates() -> dict[str, dict[str, Any]]:
    """Return what results/proofs keeps: law -> its certificate."""
    if not STORED.is_file():
        return {}
    return {certificate["law"]: certificate for certificate in read_json(STORED)["laws"]}


def certify_apart(law: Law | HasLaw, lemma_s: float = LEMMA_S, law_s: float = LAW_S) -> dict[str, Any]:
    """Return the certificate of a law, made in a process of its own, which says why it ended if it did.

    lemma_s, law_s: seconds for one question to Z3, and for the law.
    """
    inner = law.law if isinstance(law, HasLaw) else law
    request = {"name": law.name, "text": inner.text, "origin": inner.origin, "lemma_s": lemma_s, "law_s": law_s}
    limits = TimeLimits(processor_s=HARD_S, wall_s=WAITS * law_s)
    try:
        return ask(__name__, request, limits, inner.origin or law.name)
    except BadLaw as error:
        return without_proof(law, str(error))


def without_proof(law: Law | HasLaw, why: str) -> dict[str, Any]:
    """Return the certificate of a law of which nothing is proved."""
    empty: dict[str, Any] = {"theorem": None, "stands": "", "lemmas": [], "V": "", "equilibria": ""}
    empty |= {"rate": None, "delta": None, "drop": None, "cited": [], "seconds": 0.0}
    verdict = {"is_proved": False, "verdict": NOT_PROVED, "why": why, "scope": SCOPE}
    empty |= {"settling": {}, "sampled": {}, "counterexample": None}
    return {"law": law.name, "declared": law.property, **verdict, **empty}


def certify(law: Law | HasLaw) -> dict[str, Any]:
    """Return what is proved of a law, as JSON has it.

    verdict, why: "proved"; "refuted", by a state where a lemma is false and from which an episode fails; or "not
    proved". scope: what the property is about. cited: what no program checks. settling: bounds of the settling time
    from rest, or why there are none. counterexample: a state where the first false lemma is false, and how an episode
    from there ends.
    """
    from bench.findings.proofs.reasons import LIMITS
    from bench.findings.proofs.theorem import attempt

    result = attempt(law)
    proof = result.proof
    if proof is None:
        return without_proof(law, say_why_none(result))
    is_proved = proof.is_proved() and not result.late and proof.stands == law.property
    # Episodes are those of a free body, which runs no law with a state and no joints of an arm.
    alone = law if isinstance(law, Law) else None
    settling = bound_settling(alone, proof) if is_proved and alone else {}
    LIMITS.stop()  # episodes follow, and the compilation of engines
    false = next((lemma for lemma in proof.lemmas if lemma.counterexample), None)
    counterexample = replay(alone, false) if false and alone else None
    verdict, why = PROVED, ""
    if not is_proved:
        verdict, why = judge(law, result, counterexample)
    return {
        "law": law.name,
        "declared": law.property,
        **proof._asdict(),
        "cited": list(proof.cited),
        "lemmas": [lemma._asdict() for lemma in proof.lemmas],
        "is_proved": is_proved,
        "verdict": verdict,
        "why": why,
        "scope": SCOPE,
        "settling": settling,
        "sampled": measure_sampled(alone) if is_proved and alone else {},
        "counterexample": counterexample,
    }


def say_why_none(result: Any) -> str:
    """Return why a law has no proof at all, in words: each theorem's reason once."""
    if result.late:
        return f"the time for one law was over (--law-limit) while it decided: {result.late}"
    return "; ".join(dict.fromkeys(result.reasons.values())) or "no theorem fits"


def judge(law: Law | HasLaw, result: Any, counterexample: dict[str, Any] | None) -> tuple[str, str]:
    """Return the verdict on a law that is not proved, and why."""
    proof = result.proof
    failed = next((lemma for lemma in proof.lemmas if not lemma.is_proved), None)
    if failed is None and result.late:
        return NOT_PROVED, f"the time for one law was over (--law-limit) while it decided: {result.late}"
    if failed is None:
        return NOT_PROVED, f"its file declares '{law.property}', and what is proved is '{proof.stands}'"
    why = f"{failed.statement}: {failed.note}" if failed.note else f"{failed.statement}: false"
    if counterexample and counterexample["outcome"] not in ("settled", NOT_RUN):
        return REFUTED, why
    return NOT_PROVED, f"{why}, after {failed.seconds:.0f} s"


def bound_settling(law: Law, proof: Any) -> dict[str, Any]:
    """Return bounds of the settling time of a law that is proved, or why there are none."""
    from bench.findings.proofs import settling_time
    from bench.findings.proofs.reasons import DoesNotFit, TimeIsUp

    if proof.theorem != WITH_TIME:
        return {}
    try:
        return settling_time.bound(law)._asdict()
    except DoesNotFit as reason:
        return {"reason": str(reason)}
    except TimeIsUp:
        return {"reason": "the time for one law was over (--law-limit)"}


SAMPLED_S, SAMPLED_STARTS = 1e-3, (("uniform", 200), ("tumbling", 200))
"""The period for which a command is held, and the starts tried: at rest, and spinning."""


def measure_sampled(law: Law) -> dict[str, Any]:
    """Return how many episodes settle at the paper's gains where the command is held from tick to tick.

    A proof is about continuous time; this is measured beside it. Empty of a law that no such engine runs: not tested.
    """
    from bench.engines.episode import OUTCOME, Settings
    from bench.engines.simulate import run
    from bench.law.inputs import PAPERS_GAINS
    from tasks import start_set
    from tasks.rules import RULES, ticks
    from tasks.verdict import OUTCOMES

    starts = [start for name, count in SAMPLED_STARTS for start in start_set(name, count)]
    settings = Settings(PAPERS_GAINS, SAMPLED_S, ticks(5.0, SAMPLED_S), RULES.hold_ticks(SAMPLED_S))
    rows = run("ideal-held", contenders_of(law)[0], "free-body", starts, settings, ())
    outcomes = [OUTCOMES[int(row[OUTCOME])] for row in rows]
    return {"period_s": SAMPLED_S, "starts": len(starts), "settled": outcomes.count("settled")}


def describe_sampled(certificate: dict[str, Any]) -> str:
    """Return in words what was measured beside a proof."""
    measured = certificate.get("sampled")
    if not measured:
        return "We did not simulate this law with a sampled command."
    starts = count_of(measured["settled"], measured["starts"], "starts")
    return (
        "In simulations with the gains of Murphy 1988 and a control period of "
        f"{1e3 * measured['period_s']:g} ms, the body settles from {starts} that we tried."
    )


NOT_RUN = "not run"
"""The outcome where no episode is run: the state's gains are not the paper's."""


def replay(law: Law, lemma: Any) -> dict[str, Any]:
    """Return the state of a false lemma, and how an episode of the law ends that begins there at the paper's gains."""
    from bench.engines.episode import FIRST_METRIC, OUTCOME, Settings
    from bench.engines.metrics.registry import metrics_of
    from bench.engines.simulate import CONTINUOUS, run
    from bench.findings.proofs.memory import FIRST_TICK, STARTS
    from bench.law.inputs import PAPERS_GAINS
    from tasks.base import Start
    from tasks.rules import RULES, ticks
    from tasks.verdict import OUTCOMES

    state = lemma.counterexample
    w, x, y, z = (state[name] for name in ("w", "x", "y", "z"))
    omega = state["omega_x"], state["omega_y"], state["omega_z"]
    start = Start("counterexample", (w, -x, -y, -z), omega)
    described = {"quat_wxyz": start.quat_wxyz, "omega": omega, "kp": state["kp"], "kv": state["kv"]}
    if (state["kp"], state["kv"]) != tuple(PAPERS_GAINS):
        return described | {"outcome": NOT_RUN, "path_ratio": None}
    begins_as_declared = law.memory is None or lemma.statement in (STARTS, FIRST_TICK)
    begun = law if begins_as_declared else law._replace(memory=(w, x, y, z))
    dt_s, metrics = 1e-3, metrics_of(on_arm=False)
    settings = Settings(PAPERS_GAINS, dt_s, ticks(5.0, dt_s), RULES.hold_ticks(dt_s))
    row = run(CONTINUOUS, contenders_of(begun)[0], "free-body", [start], settings, metrics)[0]
    measured = {metric.column: float(value) for metric, value in zip(metrics, row[FIRST_METRIC:], strict=False)}
    outcome = {"outcome": OUTCOMES[int(row[OUTCOME])], "path_ratio": measured["path_ratio"]}
    return described | outcome


def certify_asked(request: dict, path: Path | None) -> dict[str, Any]:
    """Return the certificate of the law that is named, or whose text is given; it says so if its file is at fault."""
    certificate = _certify_asked(request, path)
    if path is None:
        return certificate
    # reasons name the user's file, not the copy of its text
    text = json.dumps(certificate).replace(path.name, Path(request["origin"]).name)
    return json.loads(text)


def _certify_asked(request: dict, path: Path | None) -> dict[str, Any]:
    # all of the prover is imported before a user's file runs, which might put something else in its place
    from bench.findings.proofs import dialect, settling_time, theorem  # noqa: F401
    from bench.findings.proofs.reasons import LIMITS, DoesNotFit, TimeIsUp, describe_error

    LIMITS.begin(request["lemma_s"], request["law_s"])
    ours = {law.name: law for law in list_laws()} | contenders("regulators")
    law = ours[request["name"]] if path is None else Law(request["name"], "", "", "")
    try:
        if path:
            # before it runs: a file that changes the prover would be judged by what it made of it
            dialect.check_file(request["text"])
            law = load_law(path, request["text"].encode())
        return certify(law)
    except TimeIsUp:
        return without_proof(law, f"the time for one law was over (--law-limit {request['law_s']:g})")
    except DoesNotFit as reason:
        return without_proof(law, str(reason))
    except Exception as error:
        return without_proof(law, describe_error(error))
    finally:
        LIMITS.stop()


if __name__ == "__main__":
    answer(certify_asked)

"""What a theorem is, what became of it for a law, and the theorems there are: one file each beside this one."""

import importlib
import pkgutil
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from bench.findings import proofs
from bench.findings.proofs.reasons import LIMITS, DoesNotFit, LemmaFails, TimeIsUp
from bench.findings.proofs.solver import Lemma
from bench.law.attribution import YOURS
from bench.law.kinds import HasLaw, Law

LASALLE = "By LaSalle's invariance principle, the body comes to rest at a point where the derivative of V stays zero."
MEASURE_ZERO = (
    "By the stable manifold theorem, the body comes to an unstable equilibrium only from a set of starts of measure "
    "zero."
)
FINITE_JUMPS = (
    "We proved by hand that V falls by at least a fixed amount at each change of the stored sign. Therefore the sign "
    "changes only a finite number of times."
)
"""Parts of a proof that no program checks, in the words of a certificate."""


class Proof(NamedTuple):
    """What a theorem says of one law.

    Attributes:
        theorem: Name of the theorem.
        stands: The property that its lemmas prove if all hold, as a law's file writes it.
        lemmas: What a program proved, or did not.
        V: The function that falls, in TeX.
        equilibria: Away from the goal.
        rate: The greatest c, to 0.01, of V' <= -c Kv |omega|^2; None if V falls otherwise.
        delta: -eta where a side that is kept ends.
        drop: What a change of side takes from V, over Kp.
        cited: What is cited, and not checked.
        seconds: How long the proof took.
    """

    theorem: str
    stands: str
    lemmas: list[Lemma]
    V: str
    equilibria: str = "none"
    rate: float | None = None
    delta: float | None = None
    drop: float | None = None
    cited: tuple[str, ...] = (LASALLE,)
    seconds: float = 0.0

    def is_proved(self) -> bool:
        """Whether every lemma holds."""
        return bool(self.lemmas) and all(lemma.is_proved for lemma in self.lemmas)


    def is_decided(self) -> bool:
        """Whether a lemma is false that every theorem needs: the command is finite, the memory is what it is said."""
        return any(lemma.counterexample and lemma.is_basic for lemma in self.lemmas)


class Theorem(NamedTuple):
    """prove(law) -> Proof; raises DoesNotFit.

    The law is a `Law`, or where `laws` names it what its file declares: it may have a state, or be a baseline.
    laws: for which of ours it is made, by name; empty if it fits by form. order: in which those are tried, the cheap
    first.
    """

    name: str
    title: str
    prove: Callable[[Any], Proof]
    laws: tuple[str, ...] = ()
    order: int = 0


@dataclass
class Attempt:
    """What came of the theorems that were tried on a law.

    Attributes:
        proof: The best proof; None if no theorem fits.
        reasons: Theorem -> why it does not fit.
        late: What was being proved when the time for the law was over; empty if it was not.
    """

    proof: Proof | None = None
    reasons: dict[str, str] = field(default_factory=dict)
    late: str = ""


def list_theorems() -> list[Theorem]:
    """Return the THEOREM of every file beside this one that has one."""
    names = [module.name for module in pkgutil.iter_modules(proofs.__path__)]
    modules = [importlib.import_module(f"{proofs.__name__}.{name}") for name in names]
    theorems = [module.THEOREM for module in modules if hasattr(module, "THEOREM")]
    return sorted(theorems, key=lambda theorem: theorem.order)


def theorems_for(law: Law | HasLaw) -> list[Theorem]:
    """Return the theorems to be tried on a law: those that are made for it, if it is ours, else those by form."""
    named = [theorem for theorem in list_theorems() if law.name in theorem.laws and law.attribution != YOURS]
    if named or isinstance(law, HasLaw):
        return named
    return [theorem for theorem in list_theorems() if not theorem.laws]


def attempt(law: Law | HasLaw) -> Attempt:
    """Try theorems on a law until one is proved: the one made for it, or those that it fits."""
    result = Attempt()
    for theorem in theorems_for(law):
        began = time.perf_counter()
        LIMITS.lemmas, LIMITS.asked = [], f"the source, traced for the theorem '{theorem.title}'"
        try:
            proof = theorem.prove(law)
        except LemmaFails as failure:
            proof = Proof(theorem.name, "", failure.lemmas, "")
        except DoesNotFit as reason:
            result.reasons[theorem.name] = str(reason)
            continue
        except TimeIsUp:
            LIMITS.stop()
            result.late = LIMITS.asked
            if result.proof is None and LIMITS.lemmas:
                result.proof = Proof(theorem.name, "", list(LIMITS.lemmas), "")
            return result
        proof = proof._replace(seconds=time.perf_counter() - began)
        if proof.is_proved() or result.proof is None:
            result.proof = proof
        if proof.is_proved() or proof.is_decided():
            break
    return result


def prove(law: Law | HasLaw) -> Proof | None:
    """Prove what a theorem says of a law: the one made for it, or the first that holds of those that it fits."""
    return attempt(law).proof

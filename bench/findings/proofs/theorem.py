"""What a theorem is, what became of it for a law, and the theorems there are: one file each beside this one."""

import importlib
import pkgutil
import time
from collections.abc import Callable
from typing import NamedTuple

from bench.findings import proofs
from bench.findings.proofs.solver import Lemma
from bench.law.kinds import Law


class DoesNotFit(Exception):
    """A law that is not of a theorem's form; the reason is its text."""


class Proof(NamedTuple):
    """What a theorem says of one law.

    stands: the property that its lemmas prove if all hold, as a law's file writes it. V: the function that falls, in
    TeX. equilibria: away from the goal. rate: the greatest c, to 0.01, of V' <= -c Kv |omega|^2; None if V falls
    otherwise. delta: -eta where a side that is kept ends; drop: what a change of side takes from V, over Kp.
    """

    theorem: str
    stands: str
    lemmas: list[Lemma]
    V: str
    equilibria: str = "none"
    rate: float | None = None
    delta: float | None = None
    drop: float | None = None
    seconds: float = 0.0

    def is_proved(self) -> bool:
        """Whether every lemma holds."""
        return all(one.is_proved for one in self.lemmas)


class Theorem(NamedTuple):
    """prove(law) -> Proof; raises DoesNotFit.

    laws: for which it is made, by name; empty if it fits by form. order: in which those are tried, the cheap first.
    """

    name: str
    title: str
    prove: Callable[[Law], Proof]
    laws: tuple[str, ...] = ()
    order: int = 0


def list_theorems() -> list[Theorem]:
    """Return the THEOREM of every file beside this one that has one."""
    modules = (
        importlib.import_module(f"{proofs.__name__}.{one.name}") for one in pkgutil.iter_modules(proofs.__path__)
    )
    found = [module.THEOREM for module in modules if hasattr(module, "THEOREM")]
    return sorted(found, key=lambda one: one.order)


def prove(law: Law) -> Proof | None:
    """Prove what a theorem says of a law: the one made for it, or the first that holds of those that it fits."""
    first = None
    named = [one for one in list_theorems() if law.name in one.laws]
    for theorem in named or [one for one in list_theorems() if not one.laws]:
        began = time.perf_counter()
        try:
            proof = theorem.prove(law)
        except DoesNotFit:
            continue
        proof = proof._replace(seconds=time.perf_counter() - began)
        if proof.is_proved():
            return proof
        first = first or proof
    return first

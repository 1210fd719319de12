"""The memory of a law that stores the side of the quaternion: from any start, with the first memory that is declared.

A theorem takes the memory to be a multiple of q, k q with k != 0. That needs two lemmas. The first is the base case:
the memory is the declared one, q is any unit quaternion, and after one tick the memory is a multiple of q. The second
is the step, which `FreeBody.ticks` makes: with a memory k q, after one tick the memory is a multiple of q again.
"""

from bench.findings.proofs.body import FreeBody
from bench.findings.proofs.reasons import DoesNotFit, LemmaFails
from bench.findings.proofs.solver import Lemma
from bench.law.inputs import NO_MEMORY
from bench.law.kinds import Law

STARTS = "from the first memory and any q, one tick makes the memory a multiple of q"
FIRST_TICK = "the command of the first tick is finite"
"""The base case: replayed from the declared memory."""


def prove_start(law: Law) -> list[Lemma]:
    """Return the lemmas on the first tick: what the memory becomes, and that the command is finite.

    Errors:
        DoesNotFit: the declared memory is no quaternion.
        LemmaFails: the memory does not become a multiple of q, or the first command is not finite.
    """
    if law.memory is None:
        return []
    if not any(law.memory):
        raise DoesNotFit(f"its first memory {tuple(law.memory)} is no quaternion: all its numbers are zero")
    body = FreeBody()
    declared = (*law.memory, *NO_MEMORY[len(law.memory) :])  # as the engines give it
    memory = tuple(body.symbols.number(part) for part in declared)
    for path in body.commands(law, memory):
        _, (_, next_memory) = path.answer
        body.find_multiple(path, next_memory, STARTS)
    finite = body.finite(FIRST_TICK)
    if not finite.is_proved:
        raise LemmaFails([finite])
    return [Lemma(STARTS, True, "Z3", finite.seconds), finite]

"""A law without a measured rate: a frame F follows the body, and the sine of the angle between them damps it.

In the goal's axes let q be the turn from R to R_d, p the quaternion of F and r that of R. With cos(theta/2) = w and
cos(theta_F/2) = p . r,

    V = 2 Kp (1 - w^2) + 4 Kv^2 (1 - (p . r)^2) + |omega|^2/2        V' = -c Kv |omega_F|^2

omega_F is the rate at which the law turns F, and c a positive number. Where V' stays zero the frame rests and theta_F
is 0 or 180°. If it is 0, the body rests too: u = 0, and sin(theta) = 0. If it is 180°, the body may swing without
damping; for that V >= 4 Kv^2. F begins at R, so that from rest V <= 2 Kp: for Kp < 2 Kv^2 the body never comes there.

Source: Lizarralde & Wen 1996; Tayebi 2008.
"""

from typing import Any

from bench.findings.proofs.body import GOAL, FreeBody
from bench.findings.proofs.solver import Lemma, by_algebra
from bench.findings.proofs.theorem import LASALLE, MEASURE_ZERO, Proof, Theorem
from bench.law.kinds import Stateful
from bench.law.so3 import dot, from_quaternion
from tasks.rotations import multiply

STAYS_BELOW = "We proved by hand: if Kp < 2 Kv^2 and the body starts at rest, then V <= 2 Kp keeps theta_F below 180°."
CITED = (LASALLE, MEASURE_ZERO, STAYS_BELOW)
BEGINS = "the frame begins at the first orientation"
FRAME = ("p_w", "p_x", "p_y", "p_z")


def conjugate(q: tuple) -> Any:
    """Return (w, -x, -y, -z)."""
    return (q[0], -q[1], -q[2], -q[3])


def prove_begin(stateful: Stateful) -> Lemma:
    """Return the lemma that the frame begins at R: the first state is a multiple of R's quaternion, never zero."""
    body = FreeBody()
    R = from_quaternion(body.q)
    for path in body.symbols.paths(lambda: stateful.begin(R)):
        body.find_multiple(path, path.answer, BEGINS)
    return body.finite(BEGINS)


def prove(stateful: Stateful) -> Proof:
    """Prove descent of a body and its frame."""
    body = FreeBody(more=FRAME, goal_frame=True)
    symbol, (kp, kv) = body.symbols.of, body.gains
    p, goal = body.symbols[FRAME], body.symbols[GOAL]
    body.symbols.relate("p_w", 1 - p[1] ** 2 - p[2] ** 2 - p[3] ** 2)
    state = tuple(symbol["size"] * one for one in multiply(goal, p))
    begins = prove_begin(stateful)
    (path,) = body.symbols.paths(lambda: body.command(stateful.law, body.omega, state))
    u, rate = path.answer
    moved: Any = tuple(one / symbol["size"] for one in multiply(conjugate(goal), rate))
    turning = tuple(2 * one for one in multiply(moved, conjugate(p))[1:])
    following = sum((one * other for one, other in zip(p, conjugate(body.q), strict=True)), body.symbols.number(0))
    spin = body.symbols.number(0.5) * dot(body.omega, body.omega)
    V = 2 * kp * (1 - body.eta**2) + 4 * kv**2 * (1 - following**2) + spin
    falls = body.derive(V, u, dict(zip(FRAME, moved, strict=True)))
    ratio = (-falls / (kv * dot(turning, turning))).value
    is_constant = bool(ratio.numer.is_ground and ratio.denom.is_ground and ratio.numer.LC * ratio.denom.LC > 0)
    lemmas = [by_algebra("V' = -c Kv |omega_F|^2, c constant and positive", is_constant)]
    lemmas += [begins, body.finite()]
    shown = r"V = 2 K_p (1 - \eta^2) + 4 K_v^2 (1 - \eta_F^2) + \tfrac12|\omega|^2"
    stands = "almost global from rest where Kp < 2 Kv^2"
    return Proof(THEOREM.name, stands, lemmas, shown, "every 180° rotation", cited=CITED)


THEOREM = Theorem("following-frame", "A frame that follows the body, in place of its rate", prove, ("velocity-free",))

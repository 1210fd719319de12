"""Two orders of selection in operational-space force control: S once, before the inertia, or twice.

S = diag(held) selects what is held, C = I - S what complies, a is the commanded acceleration of
what is held, h the wrench to exert, and Lambda = (J D^-1 J^T)^-1 the inertia at the hand. On the
rows of J:

    selected-then-decoupled    W = Lambda S a + C h
    decoupled-then-selected    W = S Lambda S a + C h
    both                       tau = J^T (W - Lambda (Jdot qdot + J z)) + D z + fg

The first is Khatib's (1987, eq. 46), and the one that Newton takes. The second is IsaacLab's. They
differ by C Lambda S a alone: the wrench along what complies that the inertia couples to the
acceleration of what is held. Each is exact where the other errs:

    motion that happens    The hand accelerates as it is commanded. It takes C Lambda S a to give it
                           a where it is held and nothing where it complies. Against a rigid wall
                           without friction the first exerts h, the second h - C Lambda S a.
    motion that is stopped    Friction or a stop holds the hand although a is not zero. No inertia
                           takes any of W, and what the hand exerts is W: along what complies h by
                           the second, h + C Lambda S a by the first.

Where Lambda has no entry between what is held and what complies they are the same.

Units: S a in m/s^2 and rad/s^2, W and h in N and N m, along the rows of J. Rows may be along the
axes of the base or the hand, or coordinates, as those of `hybrid`. z = -Kv/2 qdot on seven joints,
nothing on six (`resolved_acceleration.relax`).

Adapted: like the sources these orders command what complies no damping: unlike `transpose`, whose
motion is selected as by the first, they have neither kc nor kf, and use no measured wrench. Ours
compensate Jdot qdot, gravity, Coriolis and friction as all forms do, so that the order is all that
differs. The sources' split of Lambda into two 3 x 3 blocks, and their rules for a singular Lambda,
are left out.

Limitations: where J loses rank Lambda is not finite; J D^-1 J^T squares the condition number of J.
What complies and touches nothing is accelerated by h without a limit.
Source: after Khatib 1987, eq. 46; isaac-sim/IsaacLab@2860b383, operational_space.py, and its pull
request 7854; newton-physics/newton@c4edfb93, operational_space/model_free.py.
"""

from bench.law.control.resolved_acceleration import damp, relax
from bench.law.linalg import factor, gram, multiply, multiply_transposed, solve_factored
from bench.law.operational_space import whiten
from bench.law.scalar import kernel


@kernel
def press(selects_again, held, chain, D, fg, J, rows, gains, room, tau):
    """Write tau by the first order, or by the second if selects_again is 1.

    J is 6 x n; held[i] > 0 where S is 1.
    """
    n, drift, wrench, scratch = chain.n, room.y, room.b, room.scratch
    for i in range(6):
        drift[i] = -rows.drift[i]
        wrench[i] = 0.0
        if held[i] > 0.0:
            wrench[i] = rows.a[i]
    if n > 6:
        relax(J, drift, chain, gains, 6, room.x)
    whiten(J, D, 6, n, scratch)
    gram(scratch.V, scratch.A, 6, n)
    factor(scratch.A, 6)
    solve_factored(scratch.A, wrench, 6)
    solve_factored(scratch.A, drift, 6)
    for i in range(6):
        if held[i] > 0.0:
            wrench[i] = wrench[i] + drift[i]
        elif selects_again > 0:
            wrench[i] = rows.h[i] + drift[i]
        else:
            wrench[i] = wrench[i] + rows.h[i] + drift[i]
    multiply_transposed(J, wrench, tau, 6, n)
    for i in range(n):
        tau[i] = tau[i] + fg[i]
    if n > 6:
        _damp_elbow(D, chain, gains, room, tau)


@kernel
def _damp_elbow(D, chain, gains, room, tau):
    """Add D z."""
    n = chain.n
    for i in range(n):
        room.x[i] = 0.0
    damp(room.x, chain, gains)
    multiply(D, room.x, room.scratch.t, n, n)
    for i in range(n):
        tau[i] = tau[i] + room.scratch.t[i]

"""Control of position and force together: hybrid control, on the geometric Jacobian and on the Euler Jacobian.

tau = D y + fg + J^T w, row by row of J's frame either held or complying: the selection matrix S = diag(held) of Raibert
and Craig. What is held is commanded the acceleration a of a position law. F is the measured wrench on the hand, h what
the hand is commanded to exert, v = J qdot; where the hand complies it comes to rest with F = -h. Three forms:

    transpose    y = J^-1 (S a - (I - S) kc v - Jdot qdot)                                  w = (I - S)(h + kf (h + F))
    inverse      y = J^-1 (S a + (I - S) c - Jdot qdot)                                     w = -F
    projected    y = (S J)^+ S (a - Jdot qdot) + J^-1 (I - S)(c - Jdot qdot)                w = -F

The first is the paper's: the error of force is selected and "converted to joint torques by the Jacobian transpose"
(Murphy 1988, 3.3). Since D J^-1 = J^T Lambda with Lambda = (J D^-1 J^T)^-1, it is also that of operational space,
tau = J^T (Lambda (S a - (I - S) kc v - Jdot qdot) + w) + fg (Khatib 1987). F acts on the hand as it does on the arm:
through Lambda, and on what is held too.

On seven joints J^-1 becomes J^# = D^-1 J^T Lambda, the dynamically consistent inverse, and y = J^# (... - J z) + z with
z = -Kv/2 qdot (`resolved_acceleration.relax`). By any other inverse a wrench would turn the elbow.

The others command what complies an acceleration, c_i = (F_i + h_i)/m_i - kc v_i with an apparent inertia m, and cancel
F: impedances. `inverse` uses J^-1 S, `projected` the pseudo-inverse of what is held, S J: of all joint motions that do
what is held, the least (Fisher and Mujtaba 1991); what complies is dragged along by it.

Three frames, and with each the wrench converted to it:

    base           J,             F
    hand           diag(Q^T, Q^T) J,  diag(Q^T, Q^T) F,  Q = R R_d^T: the base's axes as the hand carries them along;
                   what is commanded is the acceleration along these axes, not of components in them
    coordinates    J_E,           F_E = diag(I, B)^T F   (Murphy 1988, 3.12)

Two more forms, `selected-then-decoupled` and `decoupled-then-selected`, differ in the order in which S and Lambda act
(`selection_order`).

`unconverted` is a negative control: the moment's components taken for generalized forces as they are.

Limitations: where J is singular, and on coordinates where B^-1 does not exist.
Source: Raibert and Craig 1981; Murphy 1988, 3.3; Khatib 1987; Fisher and Mujtaba 1991.
"""

from collections.abc import Callable

from bench.law.chain import bias_acceleration, twist
from bench.law.contender import axes_of
from bench.law.contenders.inverses.dynamically_consistent import resolve as by_least_energy
from bench.law.contenders.inverses.pseudo_inverse import resolve as by_least_squares
from bench.law.contenders.inverses.solve import resolve as by_elimination
from bench.law.contenders.jacobians import analytic
from bench.law.contenders.jacobians.geometric import fill
from bench.law.contenders.regulators import feedback_linearized
from bench.law.contenders.regulators.rotation_matrix import law as regulate
from bench.law.control.resolved_acceleration import damp, relax
from bench.law.control.selection_order import press
from bench.law.inputs import AT_REST, Goal
from bench.law.kinds import Coordinates
from bench.law.linalg import multiply, multiply_transposed
from bench.law.scalar import kernel
from bench.law.so3 import minus, rotate, rotate_back, spring_damper


@kernel
def hold_moving(p, pdot, setpoint, gains):
    """u_p = Kp (p_d - p) + Kv (v_d - pdot) [m/s^2], base frame."""
    return spring_damper(gains.kp, minus(setpoint.p_d, p), gains.kv, minus(pdot, setpoint.v_d))


@kernel
def write(buffer, linear, angular):
    """Write the six numbers of a row buffer."""
    for i in range(3):
        buffer[i] = linear[i]
        buffer[3 + i] = angular[i]


@kernel
def measure(chain, setpoint, f, m, J, rows):
    """J and all rows but a, along the axes of the base frame; returns pdot and omega."""
    pdot, omega = twist(chain)
    bias = bias_acceleration(chain)
    fill(J, chain)
    write(rows.drift, (bias[0], bias[1], bias[2]), (bias[3], bias[4], bias[5]))
    write(rows.F, f, m)
    write(rows.h, setpoint.f_d, setpoint.m_d)
    write(rows.v, pdot, omega)
    return pdot, omega


@kernel
def in_base(chain, setpoint, f, m, gains, touch, J, rows):
    """J and the rows of hybrid control along the axes of the base frame."""
    pdot, omega = measure(chain, setpoint, f, m, J, rows)
    u = regulate(chain.R, omega, Goal(setpoint.R_d, AT_REST, AT_REST), gains)
    write(rows.a, hold_moving(chain.p, pdot, setpoint, gains), u)


@kernel
def in_base_by_rate(chain, setpoint, f, m, gains, touch, J, rows):
    """Command as `in_base`, but hold a held turn by its rate alone, omegadot = -Kv omega, whatever the orientation."""
    in_base(chain, setpoint, f, m, gains, touch, J, rows)
    for i in range(3, 6):
        rows.a[i] = -gains.kv * rows.v[i]


@kernel
def carried_back(R, R_d, v):
    """Q^T v with Q = R R_d^T."""
    return rotate(R_d, rotate_back(R, v))


@kernel
def in_hand(chain, setpoint, f, m, gains, touch, J, rows):
    """J and the rows of hybrid control along the base's axes as the hand carries them along from the goal."""
    in_base(chain, setpoint, f, m, gains, touch, J, rows)
    R, R_d = chain.R, setpoint.R_d
    for i in range(chain.n):
        linear, angular = (J[0, i], J[1, i], J[2, i]), (J[3, i], J[4, i], J[5, i])
        linear, angular = carried_back(R, R_d, linear), carried_back(R, R_d, angular)
        for k in range(3):
            J[k, i] = linear[k]
            J[3 + k, i] = angular[k]
    _carry_back(R, R_d, rows.a)
    _carry_back(R, R_d, rows.drift)
    _carry_back(R, R_d, rows.F)
    _carry_back(R, R_d, rows.v)


@kernel
def _carry_back(R, R_d, row):
    write(row, carried_back(R, R_d, (row[0], row[1], row[2])), carried_back(R, R_d, (row[3], row[4], row[5])))


def in_coordinates(representation: Coordinates, converts: bool = True) -> Callable:
    """Return the rows along the coordinates of a representation, on J_E = diag(I, B^-1) J.

    converts: F_E = (f, B^T m) (Murphy 1988, 3.12); otherwise m's components as they are, a negative control.
    """
    axes_of(representation)
    chart, rates = representation.chart, representation.rates
    fill_in, drift_of = analytic.kernels_in(representation)
    law = feedback_linearized.coordinate_law_in(representation)
    convert = conversion(representation, converts)

    @kernel
    def assemble(chain, setpoint, f, m, gains, touch, J, rows):
        """J_E and the rows of hybrid control along x, y, z and E."""
        pdot, omega = twist(chain)
        at = chart(chain.R)
        Edot = rates(at, omega)
        drift = drift_of(chain, at, Edot, omega, bias_acceleration(chain))
        fill_in(J, chain, at)
        write(rows.a, hold_moving(chain.p, pdot, setpoint, gains), law(at, chart(setpoint.R_d).E, Edot, gains))
        write(rows.drift, (drift[0], drift[1], drift[2]), (drift[3], drift[4], drift[5]))
        write(rows.F, f, convert(at, m))
        write(rows.h, setpoint.f_d, convert(at, setpoint.m_d))
        write(rows.v, pdot, Edot)

    return assemble


def conversion(representation: Coordinates, converts: bool = True) -> Callable:
    """convert(chart, m): B^T m, or m's components about the axes that the coordinates stand for."""
    if converts:
        return representation.generalized
    about_first, about_second, about_third = (axes_of(representation).index(k) for k in range(3))

    @kernel
    def convert(at, m):
        return (m[about_first], m[about_second], m[about_third])

    return convert


INVERSE, PROJECTED, TRANSPOSE, SELECTED_FIRST, DECOUPLED_FIRST = 0, 1, 2, 3, 4
"""The forms, as a compiled loop takes them."""


@kernel
def exerted(form, held, rows, touch, i):
    """w_i: what the joints add to a wrench on the hand by J^T."""
    if form < TRANSPOSE:
        return -rows.F[i]
    if held[i] > 0.0:
        return 0.0
    return rows.h[i] + touch.kf * (rows.h[i] + rows.F[i])


@kernel
def comply(form, held, chain, D, fg, J, rows, gains, touch, room, tau):
    """tau = D y + fg + J^T w, with y and w by the rows that are held (held[i] > 0) or comply; J is 6 x n."""
    if form >= SELECTED_FIRST:
        press(form - SELECTED_FIRST, held, chain, D, fg, J, rows, gains, room, tau)
        return
    n, y, b, scratch = chain.n, room.y, room.b, room.scratch
    for i in range(6):
        if held[i] > 0.0:
            y[i] = rows.a[i] - rows.drift[i]
        elif form >= TRANSPOSE:
            y[i] = -touch.kc * rows.v[i] - rows.drift[i]
        else:
            inertia = touch.m_p
            if i > 2:
                inertia = touch.m_o
            y[i] = (rows.F[i] + rows.h[i]) / inertia - touch.kc * rows.v[i] - rows.drift[i]
    if n > 6:
        relax(J, y, chain, gains, 6, b)
    count = 0
    if form > INVERSE and form < TRANSPOSE:
        count = set_apart(held, n, J, y, room)
    if n > 6:
        by_least_energy(J, y, D, room.x, 6, n, scratch)
        for i in range(n):
            y[i] = 0.0
        damp(y, chain, gains)
    else:
        by_elimination(J, y, D, y, 6, n, scratch)
    if count > 0:
        by_least_squares(room.held, b, D, scratch.t, count, n, scratch)
        for i in range(n):
            y[i] = y[i] + scratch.t[i]
    for i in range(6):
        b[i] = exerted(form, held, rows, touch, i)
    multiply_transposed(J, b, scratch.t, 6, n)
    multiply(D, y, tau, n, n)
    for i in range(n):
        tau[i] = tau[i] + fg[i] + scratch.t[i]
    if n > 6:
        for i in range(n):
            tau[i] = tau[i] + room.x[i]


@kernel
def set_apart(held, n, J, y, room):
    """Move what is held from y to b, and its rows of J to room.held; returns how many they are."""
    count = 0
    for i in range(6):
        if held[i] > 0.0:
            room.b[count] = y[i]
            y[i] = 0.0
            for j in range(n):
                room.held[count, j] = J[i, j]
            count = count + 1
    return count

"""Solve for least settling times as a nonlinear program in CasADi: an oracle that shares no code with ours.

The turn's quaternion and omega at nodes, u constant between two, |u|^2 <= 1, two Runge-Kutta steps an interval. T is
free; at T the band is entered, and in a second part of free length the body stays in it and comes to rest: on the
rotations themselves, nothing seen as flat. The least T of a few drawn guesses is the answer. A finer division makes it
shorter: it lies above the least time by what the division costs.
"""

import math
from typing import NamedTuple

import casadi
import numpy as np

COMING, STAYING = 40, 16
"""Intervals before and after the entry."""

INTERVALS = COMING + STAYING
STEPS = 2

LONGEST_STAY = 3.2
"""Time within the band, at most, over sqrt(b): to touch its far edge takes 2 at most, to stop along it 1."""


class Program(NamedTuple):
    """A nonlinear program: its variables, and its parameters: where the body starts, and the band's half width."""

    opti: casadi.Opti
    state: casadi.MX
    command: casadi.MX
    time: casadi.MX
    stay: casadi.MX
    start: casadi.MX
    band: casadi.MX


def make_step():
    """Return the state after a step of h with the command u, as a function of CasADi."""
    state = casadi.MX.sym("state", 7)
    command = casadi.MX.sym("command", 3)
    h = casadi.MX.sym("h")

    def find_rates(at):
        scalar, vector, omega = at[0], at[1:4], at[4:]
        turning = -0.5 * casadi.dot(omega, vector)
        moving = 0.5 * (scalar * omega + casadi.cross(omega, vector))
        return casadi.vertcat(turning, moving, command)

    after = state
    for _ in range(STEPS):
        first = find_rates(after)
        second = find_rates(after + 0.5 * h * first)
        third = find_rates(after + 0.5 * h * second)
        fourth = find_rates(after + h * third)
        after = after + h / 6.0 * (first + 2.0 * second + 2.0 * third + fourth)
    return casadi.Function("step", [state, command, h], [after])


def make_program():
    """Return the program; its start and band are set by `solve`."""
    opti = casadi.Opti()
    program = Program(
        opti=opti,
        state=opti.variable(7, INTERVALS + 1),
        command=opti.variable(3, INTERVALS),
        time=opti.variable(),
        stay=opti.variable(),
        start=opti.parameter(7),
        band=opti.parameter(),
    )
    step = make_step()
    for k in range(INTERVALS):
        whole = program.time / COMING if k < COMING else program.stay / STAYING
        after = step(program.state[:, k], program.command[:, k], whole / STEPS)
        opti.subject_to(program.state[:, k + 1] == after)
        opti.subject_to(casadi.sumsqr(program.command[:, k]) <= 1.0)
    for k in range(COMING, INTERVALS + 1):
        sine = casadi.sin(0.5 * program.band)
        opti.subject_to(casadi.sumsqr(program.state[1:4, k]) / sine**2 <= 1.0)
    opti.subject_to(program.state[:, 0] == program.start)
    opti.subject_to(program.state[4:, INTERVALS] == 0.0)
    opti.subject_to(program.time >= 0.1)
    opti.subject_to(program.stay >= 1e-3)
    opti.subject_to(program.stay <= LONGEST_STAY * casadi.sqrt(program.band))
    opti.minimize(program.time)
    options = {"print_level": 0, "max_iter": 300, "sb": "yes"}
    opti.solver("ipopt", {"print_time": False}, options)
    return program


def multiply(left, right):
    """Return the product of two quaternions w, x, y, z."""
    scalar = left[0] * right[0] - left[1:] @ right[1:]
    vector = left[0] * right[1:] + right[0] * left[1:] + np.cross(left[1:], right[1:])
    return np.concatenate([[scalar], vector])


def guess_motion(start, time, rng):
    """Return states and commands of a motion: four drawn commands in the first half, and braking in the second."""
    commands = np.repeat(rng.standard_normal((3, 4)), COMING // 4, axis=1)
    commands /= np.maximum(np.linalg.norm(commands, axis=0), 1.0)
    h = time / COMING
    state = np.array(start, dtype=float)
    states = [state]
    for k in range(COMING):
        omega = state[4:]
        if k >= COMING // 2:
            speed = max(np.linalg.norm(omega), 1e-9)
            commands[:, k] = -omega / speed * min(1.0, speed / h)
        omega = omega + h * commands[:, k]
        angle = h * np.linalg.norm(omega)
        axis = omega / max(np.linalg.norm(omega), 1e-12)
        turn = np.concatenate([[math.cos(0.5 * angle)], math.sin(0.5 * angle) * axis])
        state = np.concatenate([multiply(turn, state[:4]), omega])
        states.append(state)
    states += STAYING * [state]
    return np.array(states).T, np.hstack([commands, np.zeros((3, STAYING))])


def solve(program, start, band, longest, rng):
    """Return the settling time from one drawn guess; infinite if the solver finds none.

    start: quaternion w, x, y, z and omega, the bound of |u| being 1. longest: of the times that are guessed.
    """
    opti = program.opti
    opti.set_value(program.start, start)
    opti.set_value(program.band, band)
    time = rng.uniform(0.4, 1.0) * longest
    states, commands = guess_motion(start, time, rng)
    opti.set_initial(program.state, states)
    opti.set_initial(program.command, commands)
    opti.set_initial(program.time, time)
    opti.set_initial(program.stay, 2.0 * math.sqrt(band))
    try:
        return float(opti.solve().value(program.time))
    except RuntimeError:
        # IPOPT gave up: another guess is drawn.
        return math.inf

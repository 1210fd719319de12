"""The closed loop over a control period by Runge-Kutta steps that are halved until two halves agree with the whole.

A step of h and two of h/2 are taken from the same state; if they differ by no more than the tolerance, the two halves
are kept (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 1993, II.4), otherwise h is
halved. Steps are the control period over a power of two, begin at multiples of themselves, and are halved down to two
of `divisions`, which are kept whatever they differ by.

A law is asked at every stage, as a continuous-time simulation asks it, beside the control period too. One with a memory
keeps what it gave at the beginning of a step that is kept: a continuous law with jumps in the limit of short steps.

Limitations: where the command has no limit (beside a pole), steps of any length differ; see `convergence`.
"""

from typing import NamedTuple

from bench.engines.ideal import plus, rk4_step
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import dot

GROWS = 2.0**-12
"""Share of the squared tolerance: two halves so near to the whole would be near enough at twice the step, whose error
is 32 times as large."""


CRAWL, ROUGH = 3, 1e-2
"""Steps in a row, each as short as any and not good enough, and the sum of what all such steps differed by, above which
an episode is not resolved. A command that jumps takes one step and leaves 1e-3 at 1 us; a command without a limit takes
dozens, and a law that is too stiff for the step leaves more than the body's own motion."""


class Effort(NamedTuple):
    """Steps of an episode; those of a plant with one step a tick stay zero.

    size, shortest: the present one and the shortest, in divisions; steps: how many. row, longest: not good enough in a
    row, now and at most; rough: what all such differed by.
    """

    size: int = 0
    shortest: int = 0
    steps: int = 0
    row: int = 0
    longest: int = 0
    rough: float = 0.0


NO_EFFORT = Effort()


@kernel
def difference_squared(R, omega, other, other_omega):
    """|R - R'|^2 + |omega - omega'|^2/(1 + |omega|^2), speeds in rad/s; not a number if one of them is none."""
    n, o, a = plus(R.n, -1.0, other.n), plus(R.o, -1.0, other.o), plus(R.a, -1.0, other.a)
    w = plus(omega, -1.0, other_omega)
    return dot(n, n) + dot(o, o) + dot(a, a) + dot(w, w) / (1.0 + dot(omega, omega))


@kernel
def refined_step(evaluate, R, omega, u, goal, gains, memory, numbers, effort):
    """(R, omega, memory, effort) one control period on; u and memory are those at its beginning.

    Gives up, in the middle of the period, after numbers.most_steps in an episode or at a state that is no number.
    """
    size, shortest, steps, row, longest, rough = effort
    if size == 0:
        size = shortest = numbers.divisions
    unit = numbers.dt / numbers.divisions
    at, is_known, whole, whole_omega = 0, False, R, omega
    while at < numbers.divisions and steps <= numbers.most_steps:
        h = size * unit
        if not is_known:
            whole, whole_omega = rk4_step(evaluate, R, omega, u, goal, gains, memory, h)
        middle, middle_omega = rk4_step(evaluate, R, omega, u, goal, gains, memory, 0.5 * h)
        u_middle, memory_middle, _ = evaluate(middle, middle_omega, goal, gains, memory)
        end, end_omega = rk4_step(evaluate, middle, middle_omega, u_middle, goal, gains, memory_middle, 0.5 * h)
        squared = difference_squared(whole, whole_omega, end, end_omega)
        steps += 1
        if not squared <= numbers.tolerance_squared:
            if size > 2:  # the next whole step is the first half of this one
                size, is_known, whole, whole_omega = size // 2, True, middle, middle_omega
                continue
            row, rough = row + 1, rough + sqrt(squared)
        else:
            row = 0
        at, is_known = at + size, False
        shortest, longest = min(shortest, size), max(longest, row)
        R, omega, memory = end, end_omega, memory_middle
        if squared - squared != 0.0:
            break
        if at < numbers.divisions:
            u, memory, _ = evaluate(R, omega, goal, gains, memory)
            if squared <= GROWS * numbers.tolerance_squared and at % (2 * size) == 0:
                size *= 2
        elif squared <= GROWS * numbers.tolerance_squared:
            size = min(2 * size, numbers.divisions)
    return R, omega, memory, Effort(size, shortest, steps, row, longest, rough)


@kernel
def step_of(effort, numbers):
    """Return the shortest step taken [s], negative if some were too long; not a number if the episode was given up."""
    if effort.steps > numbers.most_steps:
        return float("nan")
    shortest = 0.5 * effort.shortest * (numbers.dt / numbers.divisions)
    return shortest if effort.longest <= CRAWL and effort.rough <= ROUGH else -shortest

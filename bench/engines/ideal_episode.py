"""The loop over episodes on the ideal plant, for all laws: one start at a time, by steps of one of three kinds.

What the judge and the metrics see is the state at the beginning of each control period, whatever steps lie between.
"""

from numba import types

from bench.engines.compiled import CURVES, EVALUATE, FOUR, MATRIX, NUMBERS, compile_function
from bench.engines.curve import keep
from bench.engines.episode import STEP, Sample, blamed, finish
from bench.engines.ideal import angle_between, haversine, held_step, rk4_step
from bench.engines.refined import NO_EFFORT, refined_step, step_of
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.scalar import kernel
from bench.law.so3 import dot, from_quaternion
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


@kernel
def _whole_step(evaluate, R, omega, u, goal, gains, memory, numbers, effort):
    at, speed = rk4_step(evaluate, R, omega, u, goal, gains, memory, numbers.dt)
    return at, speed, memory, effort


@kernel
def _held_step(evaluate, R, omega, u, goal, gains, memory, numbers, effort):
    """The tick's command holds, and no law is asked."""
    at, speed = held_step(R, omega, u, numbers.dt)
    return at, speed, memory, effort


REFINED = "ideal-rk4-refined"
"""How `convergence` asks for the steps of `refined`; no engine by itself."""

STEPS = {"ideal-rk4": _whole_step, "ideal-held": _held_step, REFINED: refined_step}
"""A law is called by pointer, 10 ns each time, once a tick or four times. With the law compiled into a loop of its own
a Runge-Kutta tick was a sixth to a third shorter, and each law took 2 s and 16 MB an engine to compile."""

EPISODES = types.void(types.FunctionType(EVALUATE), FOUR, MATRIX, NUMBERS, MATRIX, CURVES)


def episodes_of(engine, observe):
    """The loop over episodes, for all laws: `episodes(evaluate, memory0, ..., rows, curves)` fills the last two."""
    step = STEPS[engine]

    def episodes(evaluate, memory0, starts, numbers, rows, curves):
        gains = Gains(numbers.kp, numbers.kv)
        dt = numbers.dt
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            R = from_quaternion((start[0], start[1], start[2], start[3]))
            omega = (start[4], start[5], start[6])
            R_d = from_quaternion((start[7], start[8], start[9], start[10]))
            goal = Goal(R_d, AT_REST, AT_REST)
            band = start[11]
            memory, effort = memory0, NO_EFFORT
            u = AT_REST
            hav = haversine(R, R_d)
            watch = first_watch(hav, band, dot(omega, omega), numbers.slow_squared)
            tick = 0
            failure = GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                before = u
                u, memory, margin = evaluate(R, omega, goal, gains, memory)
                sample = Sample(tick * dt, dt, R, hav, watch.entries > 0, watch.rest > 0, omega, u, before, margin)
                observe(row, sample)
                keep(curves, k, tick, sample)
                failure = check_command(dot(u, u), numbers.command_limit_squared)
                if failure != GOING:
                    break
                R, omega, memory, effort = step(evaluate, R, omega, u, goal, gains, memory, numbers, effort)
                tick += 1
                speed = dot(omega, omega)
                failure = check_state(speed, numbers.speed_limit_squared)
                if failure != GOING or effort.steps > numbers.most_steps:
                    break
                hav = haversine(R, R_d)
                watch = watched(watch, tick, hav, band, speed, numbers.slow_squared)
            final, speed = angle_between(R, R_d), dot(omega, omega)
            finish(row, blamed(failure, u), watch, tick, final, speed, dot(u, u), numbers)
            row[STEP] = step_of(effort, numbers)

    return compile_function(episodes, EPISODES)

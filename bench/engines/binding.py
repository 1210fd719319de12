"""A contender's law and metrics in the one form that every engine calls.

command(R, omega, goal, gains, memory) -> (u, memory)      margin(R, R_d) -> number      observe(row, sample)
evaluate(R, omega, goal, gains, memory) -> (u, memory, margin)

On an analytic Jacobian the command is that of the coordinates: command(chart, E_d, Edot, gains) -> u_E.
"""

import functools
import math

import tasks
from bench.engines.episode import CRASHED_COMMAND, FIRST_METRIC, has_crashed
from bench.law.contender import Contender
from bench.law.control.resolved_acceleration import Parts, parts_of
from bench.law.inputs import NO_MEMORY, Gains
from bench.law.kinds import OnCoordinates
from bench.law.scalar import kernel
from bench.law.so3 import relative
from tasks.base import Task


def command_of(contender: Contender):
    """Return the law with a memory slot; in the place of a user's law that raises stands CRASHED_COMMAND.

    So it does for one that returns anything but three numbers in some state. Times 1.0 keeps every bit of a number.
    """
    if contender.is_by_coordinates:
        guarded = _guarded_four if contender.rows == 7 else _guarded_three
        return guarded(contender.coordinate_law) if contender.regulator.origin else contender.coordinate_law
    if contender.regulator.law is None and contender.baseline is not None:
        return None  # a baseline on the joints has no law of an orientation
    law = contender.law if contender.regulator.memory is not None else _memoryless(contender.law)
    return _guarded_memory(law) if contender.regulator.origin else law


def parts_for(contender: Contender) -> Parts:
    """Return the parts of a controller on an arm with its law as `command_of` has it."""
    parts = parts_of(contender, command_of(contender))
    if contender.regulator.origin and parts.coordinates is not None:
        return parts._replace(report=_passing_crashes_on(parts.coordinates.accelerate))
    return parts


def _guarded_three(law):
    @kernel
    def command(at, E_d, Edot, gains):
        try:
            x, y, z = law(at, E_d, Edot, gains)
            u = (1.0 * x, 1.0 * y, 1.0 * z)
        except Exception:
            u = CRASHED_COMMAND
        return u

    return command


def _guarded_four(law):
    """Guard a function that returns four coordinates."""

    @kernel
    def command(at, E_d, Edot, gains):
        try:
            w, x, y, z = law(at, E_d, Edot, gains)
            u_E = (1.0 * w, 1.0 * x, 1.0 * y, 1.0 * z)
        except Exception:
            u_E = (*CRASHED_COMMAND, math.nan)
        return u_E

    return command


def _passing_crashes_on(accelerate):
    @kernel
    def report(at, Edot, u_E):
        if has_crashed(u_E):
            return CRASHED_COMMAND
        return accelerate(at, Edot, u_E)

    return report


def _memoryless(law):
    @kernel
    def command(R, omega, goal, gains, memory):
        return law(R, omega, goal, gains), memory

    return command


def _guarded_memory(law):
    @kernel
    def command(R, omega, goal, gains, memory):
        try:
            (x, y, z), after = law(R, omega, goal, gains, memory)
            u = (1.0 * x, 1.0 * y, 1.0 * z)
        except Exception:
            u, after = CRASHED_COMMAND, memory
        return u, after

    return command


def plant_of(contender: Contender, task: str, gains: Gains) -> Task:
    """Return the judge's task, with MuJoCo's actuator in place of the motors if that makes the command."""
    chosen = tasks.task(task)
    return chosen.with_servo(gains.kp, gains.kv) if contender.regulator.in_engine else chosen


def memory_of(contender: Contender) -> tuple:
    """Four numbers: the law's initial memory, filled up with zeros."""
    memory = contender.regulator.memory or ()
    return (*(float(x) for x in memory), *NO_MEMORY[len(memory) :])


@functools.cache
def margin_of(contender: Contender):
    """Return the margin of the coordinates the law acts on; of a law on R its own, or NaN if it is singular nowhere."""
    if contender.representation is None:
        return contender.regulator.margin or _no_margin
    at, law = contender.representation.margin, contender.regulator.law
    is_relative = isinstance(law, OnCoordinates) and law.relative

    @kernel
    def margin(R, R_d):
        return at(relative(R_d, R) if is_relative else R)

    return margin


@kernel
def _no_margin(R, R_d):
    return math.nan


def evaluation_of(contender: Contender):
    """Return the law and its margin as one function, so that what both compute is computed once, and called once."""
    command, margin = command_of(contender), margin_of(contender)

    @kernel
    def evaluate(R, omega, goal, gains, memory):
        u, memory = command(R, omega, goal, gains, memory)
        return u, memory, margin(R, goal.R)

    return evaluate


@kernel
def _nothing(row, sample):
    return None


def observer(metrics):
    """All metrics' updates as one function on the row."""
    observe = _nothing
    for column, metric in enumerate(metrics, start=FIRST_METRIC):
        observe = _then(observe, metric.update, column)
    return observe


def _then(before, update, column):
    @kernel
    def observe(row, sample):
        before(row, sample)
        row[column] = update(row[column], sample)

    return observe

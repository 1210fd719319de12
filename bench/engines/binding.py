"""A contender's law and metrics in the one form that every engine calls.

command(R, omega, goal, gains, memory) -> (u, memory)      margin(R, R_d) -> number      observe(row, sample)
evaluate(R, omega, goal, gains, memory) -> (u, memory, margin)

On an analytic Jacobian the command is that of the coordinates: command(chart, E_d, Edot, gains) -> u_E.
"""

import math

import tasks
from bench.contender import NO_MEMORY, Contender, Gains
from bench.engines.episode import FIRST_METRIC
from bench.scalar import kernel
from bench.so3 import relative
from tasks.base import Task

NOT_A_NUMBER = (math.nan, math.nan, math.nan)


def command_of(contender: Contender):
    """The law with a memory slot; a user's law that raises commands NaN, which the judge sees as singular.

    So does one that returns anything but three numbers in some state. Times 1.0 keeps every bit of a number.
    """
    if contender.jacobian is not None and contender.jacobian.takes == "coordinates":
        return _coordinate_command_of(contender)
    law = contender.law
    if contender.regulator.memory is not None:
        return _guarded_memory(law) if contender.regulator.origin else law
    return _guarded(law) if contender.regulator.origin else _memoryless(law)


def _coordinate_command_of(contender: Contender):
    law = contender.coordinate_law
    return _guarded_coordinates(law) if contender.regulator.origin else law


def _guarded_coordinates(law):
    @kernel
    def command(at, E_d, Edot, gains):
        try:
            u_E = law(at, E_d, Edot, gains)
        except Exception:
            u_E = NOT_A_NUMBER
        return u_E

    return command


def _memoryless(law):
    @kernel
    def command(R, omega, goal, gains, memory):
        return law(R, omega, goal, gains), memory

    return command


def _guarded(law):
    @kernel
    def command(R, omega, goal, gains, memory):
        try:
            x, y, z = law(R, omega, goal, gains)
            u = (1.0 * x, 1.0 * y, 1.0 * z)
        except Exception:
            u = NOT_A_NUMBER
        return u, memory

    return command


def _guarded_memory(law):
    @kernel
    def command(R, omega, goal, gains, memory):
        try:
            (x, y, z), after = law(R, omega, goal, gains, memory)
            u = (1.0 * x, 1.0 * y, 1.0 * z)
        except Exception:
            u, after = NOT_A_NUMBER, memory
        return u, after

    return command


def plant_of(contender: Contender, task: str, gains: Gains) -> Task:
    """The judge's task, with MuJoCo's actuator in place of the motors if that makes the command."""
    chosen = tasks.task(task)
    return chosen.with_servo(gains.kp, gains.kv) if contender.regulator.in_engine else chosen


def memory_of(contender: Contender) -> tuple:
    """Four numbers: the law's initial memory, filled up with zeros."""
    memory = contender.regulator.memory or ()
    return (*(float(x) for x in memory), *NO_MEMORY[len(memory) :])


def margin_of(contender: Contender):
    """The margin of the coordinates the law acts on; of a law on R its own, or NaN if it is singular nowhere."""
    if contender.representation is None:
        return contender.regulator.margin or _no_margin
    at = contender.representation.margin
    return _margin_from_goal(at) if contender.regulator.relative else _margin_from_base(at)


@kernel
def _no_margin(R, R_d):
    return math.nan


def _margin_from_base(at):
    @kernel
    def margin(R, R_d):
        return at(R)

    return margin


def _margin_from_goal(at):
    @kernel
    def margin(R, R_d):
        return at(relative(R_d, R))

    return margin


def evaluation_of(contender: Contender):
    """The law and its margin as one function, so that what both compute is computed once, and called once."""
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

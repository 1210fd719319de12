"""Poses of wrench-probe as a metric sees them, run by the native engine."""

import functools

import tasks
from bench.contenders.registry import known_impedances, known_representations
from bench.control.contact_controller import hybrid, springy
from bench.engines.run_contact import run
from bench.metrics.contact_metric import Pose, response
from tasks.domains.wrench_probe import TASK, trials

COORDINATES = {word: one for word, one in known_representations().items() if one.about is not None}
# Singular away from zero, at zero, and nowhere; every pair that is run has to be compiled.
TRIED = ("zyx-euler", "zyz-euler", "mrp")
HYBRIDS = [
    *(hybrid(law, form) for law in ("hybrid-base", "hybrid-rate", "hybrid-hand") for form in ("inverse", "projected")),
    *(hybrid("hybrid", form, COORDINATES[word]) for word in TRIED for form in ("inverse", "projected")),
]
SPRINGS = [
    springy(impedance, one)
    for impedance in known_impedances().values()
    for one in ([COORDINATES[word] for word in TRIED] if impedance.law_in else [None])
]


@functools.cache
def probed(controller, complies="about x and y", alpha=0, beta=30, gamma=0, arm="ur5e") -> Pose:
    """One pose of the default probe: angles in degrees, the order by its name."""
    on = tasks.arm(arm)
    words = f"alpha{alpha:+d} beta{beta:+d} gamma{gamma:+d}, {complies}"
    chosen = tuple(trial for trial in trials(on) if trial.pose == words)
    assert chosen, f"no pose '{words}'"
    ended = run("native", controller, TASK, on, chosen)
    return Pose(TASK, on, controller, tuple(response(*each) for each in zip(chosen, ended, strict=True)))

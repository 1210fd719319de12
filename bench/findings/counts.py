"""How many there are of what the book, the README and the changelog count: each number once, with what it counts.

Pages compute their numbers from a run; a test holds them, and those that prose has by hand, against these.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np

import tasks
from bench.contenders.registry import all_contenders, papers_laws
from bench.files import read_json
from bench.findings.claims import all_claims
from bench.findings.perturbed import perturbations
from bench.tables.schema import RESULTS

AT_REST = ("half-turn", "poles", "wraps", "box")
"""Directed sets of starts at rest whose goal is the identity: points of SO(3) alone."""

DIRECTED = (*AT_REST, "tumbling", "goals")
"""All sets but the evenly spread one and the paper's three examples."""

OURS = "orientation-bench"
"""What results/libraries calls our own laws, which were asked beside the libraries."""


class Count(NamedTuple):
    """A number, and what it is the number of."""

    number: int
    meaning: str


@functools.cache
def counts() -> dict[str, Count]:
    """Every count, by a word for it."""
    run = [one for one in all_contenders() if not one.regulator.costing_only]
    laws = [one for one in run if not one.regulator.control]
    continuous = [one for one in laws if not one.regulator.in_engine]
    later = {one.regulator.name for one in run if one.regulator.later and not one.regulator.in_engine}
    libraries = set(read_json(RESULTS / "libraries" / "provenance.json")["libraries"]) - {OURS}
    return {
        "papers": Count(len(papers_laws()), "the paper's laws"),
        "laws": Count(len(laws), "laws in all their coordinates, MuJoCo's own actuator among them"),
        "continuous": Count(len(continuous), "laws that run on the continuous plant: all but MuJoCo's actuator"),
        "later": Count(len(later), "later laws, one of the negative controls among them, MuJoCo's actuator apart"),
        "controls": Count(len(run) - len(laws), "negative controls: laws that must fail"),
        "perturbations": Count(len(perturbations()), "perturbations of the free body"),
        "axes": Count(len(tasks.axis_names()), "axes: the perturbations, and gains that make peak commands equal"),
        "arms": Count(len(tasks.arm_names()), "arms"),
        "claims": Count(len(all_claims()), "sentences of the paper that are decided"),
        "libraries": Count(len(libraries), "robot libraries, our own laws apart"),
        "half-turns": Count(exact_half_turns(), "exact 180° rotations of the set of that name"),
        "half-turn-starts": Count(tasks.start_set_size("half-turn"), "starts at and near 180° rotations, that set"),
        "at-rest": Count(sum(map(tasks.start_set_size, AT_REST)), "directed starts at rest, set by set"),
        "orientations": Count(len(orientations()), "the same, each orientation once"),
        "directed": Count(sum(map(tasks.start_set_size, DIRECTED)), "directed starts, those that tumble among them"),
    }


def exact_half_turns() -> int:
    """Starts of the set half-turn whose quaternion's scalar is zero."""
    return sum(not start.quat_wxyz[0] for start in tasks.start_set("half-turn"))


def orientations() -> np.ndarray:
    """The orientations of the directed sets at rest, each once, as matrices: shape (n, 9), to the last digits but 3."""
    from scipy.spatial.transform import Rotation

    turns = [start.quat_wxyz for name in AT_REST for start in tasks.start_set(name)]
    matrices = Rotation.from_quat(np.array(turns), scalar_first=True).as_matrix().reshape(-1, 9)
    return np.unique(matrices.round(13) + 0.0, axis=0)

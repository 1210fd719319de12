"""What a metric of contact is: a number from the records of the trials that share a pose, in plain numpy."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from bench.law.control.contact_controller import ContactController
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial

if TYPE_CHECKING:
    from bench.engines.contact_episode import EndedEpisode


class ContactResponse(NamedTuple):
    """One episode, tick by tick, base frame: N ticks.

    time (N) [s]; R (N x 3 x 3), hand to base; omega (N x 3) [rad/s]; p (N x 3) [m]; force, moment (N x 3) on the hand
    [N], [N m]; gap (N) to the scene [m], negative where they penetrate; turned (N), angle of the scene's joint [rad];
    load (N), the largest torque over its rated one. rested: whether it ended at rest, before its horizon.
    """

    trial: Trial
    outcome: str
    time: np.ndarray
    R: np.ndarray
    omega: np.ndarray
    p: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    gap: np.ndarray
    turned: np.ndarray
    load: np.ndarray
    rested: bool = False


@dataclass(frozen=True, eq=False)
class Pose:
    """What a row of compliance.parquet is about: the responses of the trials that share a pose, in their order.

    What several metrics need of a pose is computed `once_a_pose`.
    """

    task: ContactTask
    arm: Arm
    controller: ContactController
    responses: tuple[ContactResponse, ...]

    @property
    def first(self) -> ContactResponse:
        """The only response, of most tasks."""
        return self.responses[0]


T = TypeVar("T")


def once_a_pose(compute: Callable[[Pose], T]) -> Callable[[Pose], T]:
    """Return the function that computes once for each pose; what it found goes when the pose does."""
    found: weakref.WeakKeyDictionary[Pose, T] = weakref.WeakKeyDictionary()

    @functools.wraps(compute)
    def once(pose: Pose) -> T:
        if pose not in found:
            found[pose] = compute(pose)
        return found[pose]

    return once


class ContactMetric(NamedTuple):
    """One column of compliance.parquet.

    measure(pose) -> the number, NaN where it has no meaning (a task of another kind, an episode that broke off before
    there is anything to measure).
    """

    column: str
    unit: str
    title: str
    measure: Callable[[Pose], float]


def response(trial: Trial, ended: EndedEpisode) -> ContactResponse:
    """Return the arrays of an episode's record; ticks at which it holds nothing finite stay as they are."""
    from bench.engines.contact_episode import FORCE, GAP, LOAD, MOMENT, OMEGA, TIME, TURNED, P, R

    record = ended.record
    frames = record[:, R:OMEGA].reshape(-1, 3, 3).transpose(0, 2, 1)
    return ContactResponse(
        trial,
        ended.outcome,
        record[:, TIME],
        frames,
        record[:, OMEGA:P],
        record[:, P:FORCE],
        record[:, FORCE:MOMENT],
        record[:, MOMENT:GAP],
        record[:, GAP],
        record[:, TURNED],
        record[:, LOAD],
        ended.rested,
    )

"""Jacobians over an arm's poses: where J_E is singular of its own, and if its derivations agree (Murphy 1988, 3.1).

    J      6 x n, by MuJoCo; and by our own kernels, from MuJoCo's axes and anchors
    J_E    diag(I, B^-1) J by conversion (3.3), and by differentiating the coordinates of R (3.5)

Condition numbers are of the 2-norm, in metres and radians, over six singular values: of a quaternion's seven rows one
is dependent. What is not finite has the condition number infinity. The poses are those of `pose_sets`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

import tasks
from bench.base.on_first_use import pd
from bench.experiments import arm as arms
from bench.experiments.columns import read_table
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.law.chain import Chain
from bench.law.contenders.registry import contenders, papers_coordinates
from bench.law.kinds import Coordinates
from bench.law.so3 import Rotation

if TYPE_CHECKING:
    from bench.experiments.jacobians.pose_sets import JointPose
    from tasks.kinematics import Kinematics

ARM_S, POSE_S = 5.0, 5e-3
"""CPU seconds of an arm's directed poses, and of each random one."""

LONGEST = 7
"""Joints that the table has columns for."""

STEP = float(np.finfo(float).eps) ** (1 / 3)
"""rad, times the margin: where truncation and rounding of a central difference are alike, both about eps^(2/3)."""

PAPERS = papers_coordinates().name
"""The paper's coordinates, of which more is checked: differences, the determinant, and a second derivation."""

JUMP = 1.0
"""rad: a change of coordinates over one step that is none of the motion's but a wrap."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return a unit for each arm that episodes are run on; `count` random poses."""
    count = request.section("jacobians")["poses"]
    names = dict.fromkeys(unit.arm for unit in arms.units(request) if count)
    return tuple(of_arm(name, count) for name in names)


def of_arm(name: str, count: int) -> Unit:
    """Return the unit of an arm, with so many random poses."""
    return Unit("jacobians", arm=name, count=count, total=count)


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return one row a pose and representation."""
    from bench.experiments.jacobians.pose_sets import poses
    from tasks.kinematics import Kinematics

    arm = tasks.arm(unit.arm)
    kin, chosen = Kinematics(arm), poses(arm, unit.count, request.seed)
    with np.errstate(all="ignore"):
        chains, Js = zip(*(look(kin, pose.q) for pose in chosen), strict=True)
        ours = filled("geometric", None, chains, chains)
        q, J = np.full((len(chosen), LONGEST), np.nan), np.array(Js)
        q[:, : arm.joints] = [pose.q for pose in chosen]
        shared = {
            "arm": arm.name,
            "pose_set": [pose.set for pose in chosen],
            "pose_id": [pose.id for pose in chosen],
            **{f"q_{i + 1}": q[:, i] for i in range(LONGEST)},
            "beta": [math.atan2(-chain.R.n[2], math.hypot(chain.R.n[0], chain.R.n[1])) for chain in chains],
            "condition": conditions(J),
            "kernel_gap": gap(ours, J),
            "det": determinants(J),
        }
        every = contenders("representations").values()
        parts = [pd.DataFrame({**shared, **_of(kin, chosen, chains, ours, one)}) for one in every]
    return pd.concat(parts, ignore_index=True)


def tool_at(kin: Kinematics, q: Sequence[float] | np.ndarray) -> tuple[np.ndarray, Rotation]:
    """Return the tool's position [m] and orientation as MuJoCo's matrix."""
    p, _ = kin.pose(q)
    m = kin.data.site_xmat[kin.site]
    return p, Rotation((m[0], m[3], m[6]), (m[1], m[4], m[7]), (m[2], m[5], m[8]))


def look(kin: Kinematics, q: Sequence[float]) -> tuple[Chain, np.ndarray]:
    """Return what a controller sees of a pose, at rest; and J."""
    J, n, (p, R) = kin.jacobian(q), kin.arm.joints, tool_at(kin, q)
    return Chain(n, kin.data.xaxis.copy(), kin.data.xanchor.copy(), np.zeros(n), tuple(p), R), J


def _of(
    kin: Kinematics,
    poses: list[JointPose],
    chains: Sequence[Chain],
    ours: np.ndarray,
    one: Coordinates,
) -> dict:
    """Return the columns of one representation; ours: J at every pose by our kernel."""
    charts = [one.chart(chain.R) for chain in chains]
    J_E = filled("analytic", one, chains, charts)
    margin = np.array([one.margin(chain.R) for chain in chains], dtype=float)
    derivation, difference = np.full((2, len(margin)), np.nan)
    drawn = np.array([pose.set == "slice" for pose in poses])
    if one.differentiate is not None:
        some = np.flatnonzero(~drawn | (one.name == PAPERS)).tolist()
        again = filled("analytic-differentiated", one, [chains[i] for i in some], [charts[i] for i in some])
        derivation[some] = gap(again, J_E[some])
    if one.name == PAPERS:
        qs = np.array([pose.q for pose in poses])[~drawn]
        difference[~drawn] = gap(_differences(kin, one, qs, margin[~drawn]), J_E[~drawn])
    return {
        "representation": one.name,
        "margin": margin,
        "condition_analytic": conditions(J_E),
        "largest": abs(J_E[:, 3:]).max(axis=(1, 2)),
        "det_analytic": determinants(J_E),
        "det_gap": _det_gap(ours, J_E, margin) if one.name == PAPERS else np.nan,
        "derivation_gap": derivation,
        "difference_gap": difference,
    }


def filled(jacobian: str, representation: Coordinates | None, chains: Sequence[Chain], charts: Sequence) -> np.ndarray:
    """Compute the Jacobian of that name at every pose, N x rows x n."""
    fill = contenders("jacobians")[jacobian].kernels_in(representation)[0]
    rows = 3 + len(representation.symbols) if representation else 6
    Js = np.empty((len(chains), rows, chains[0].n))
    for J, chain, at in zip(Js, chains, charts, strict=True):
        fill(J, chain, at) if representation else fill(J, chain)
    return Js


def conditions(J: np.ndarray) -> np.ndarray:
    """Compute largest over sixth singular value of each; infinite where an element is not finite."""
    good = np.isfinite(J).all(axis=(1, 2))
    s = np.linalg.svd(np.where(good[:, None, None], J, 0.0), compute_uv=False)
    with np.errstate(all="ignore"):
        return np.where(good & (s[:, 5] > 0), s[:, 0] / s[:, 5], np.inf)


def determinants(J: np.ndarray) -> np.ndarray:
    """Compute det of each six by six; NaN of other shapes."""
    return np.linalg.det(J) if J.shape[1:] == (6, 6) else np.full(len(J), np.nan)


def gap(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Compute the largest difference of elements over the largest element of `other`."""
    return abs(one - other).max(axis=(1, 2)) / abs(other).max(axis=(1, 2))


def _det_gap(J: np.ndarray, J_E: np.ndarray, cos_beta: np.ndarray) -> np.ndarray:
    """Compute |det J_E + det J / cos(beta)| over the product of J_E's row norms, the scale of a determinant's rounding.

    J is ours: an element near zero is known to eps of a metre only, so that MuJoCo's and ours differ by all of it.
    """
    scale = np.linalg.norm(J_E, axis=2).prod(axis=1)
    return abs(determinants(J_E) + determinants(J) / cos_beta) / scale


def _differences(kin: Kinematics, one: Coordinates, qs: np.ndarray, margin: np.ndarray) -> np.ndarray:
    """Compute central differences of position and coordinates, N x rows x n; NaN beside a jump of the coordinates."""
    n = kin.arm.joints
    ends, steps = np.empty((2, len(qs), 3 + len(one.symbols), n)), np.empty((2, len(qs), n))
    for place, (q, h) in enumerate(zip(qs, STEP * margin, strict=True)):
        for i in range(n):
            for end, moved in enumerate((q[i] + h, q[i] - h)):
                there = q.copy()
                there[i] = steps[end, place, i] = moved
                p, R = tool_at(kin, there)
                ends[end, place, :3, i], ends[end, place, 3:, i] = p, one.chart(R).E
    change = ends[0] - ends[1]
    change = np.where(abs(change) > JUMP, np.remainder(change + math.pi, math.tau) - math.pi, change)
    change = np.where(abs(change).max(axis=(1, 2), keepdims=True) > JUMP, np.nan, change)
    return change / (steps[0] - steps[1])[:, None, :]


EXPERIMENT = Experiment.of(
    globals(),
    "Jacobians over an arm's poses",
    table=read_table(__file__, "poses"),
    takes=("tasks", "arms"),
    cost_s=lambda unit: ARM_S + POSE_S * unit.count,
    compiles=False,
)

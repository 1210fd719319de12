"""How a hand in free space yields to known moments: C, the rotation it has made per moment, 3 x 3.

    phi_k = log(R_end R_start^T) = C m_k        over the moments m_k on it, by least squares

Moments that come with their opposites leave in C what is proportional to them: what grows with their square cancels.
An isotropic hand has C = c I. Base frame, radians, N m.

Limitations: NaN where the moments do not span space, where something else touches the hand, and where an episode broke
off.
"""

import numpy as np

from bench.engines.metrics.contact_metric import Pose, once_a_pose
from tasks.contact import Trial

NOTHING = np.full((3, 3), np.nan)
# A moment that turns the hand by less [rad/(N m)] turns it not at all: about axes that are held 1e-10 is left, and a
# millionth of a radian beside a pole, where what is left goes with the sine of the distance, there is still 1e-8.
STILL = 1e-9


def rotation_vector(R: np.ndarray) -> np.ndarray:
    """log R [rad], ... x 3, of rotation matrices, ... x 3 x 3: theta k, theta in [0, pi).

    Limitations: within 1e-8 rad of a 180° rotation nothing is left of the axis.
    """
    sine = 0.5 * np.stack(
        (R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]), axis=-1
    )
    size = np.linalg.norm(sine, axis=-1)
    cosine = 0.5 * (np.trace(R, axis1=-2, axis2=-1) - 1.0)
    stretch = np.divide(np.arctan2(size, cosine), size, out=np.ones_like(size), where=size > 0.0)
    return stretch[..., None] * sine


def turned(R: np.ndarray) -> np.ndarray:
    """Rotation vector [rad] from the first to the last of N orientations, N x 3 x 3, base frame."""
    return rotation_vector(R[-1] @ R[0].T)


def is_moment(trial: Trial) -> bool:
    """Whether one moment, and no force, pushes the hand from the first tick to the last."""
    return not trial.legs and not any(trial.push[:3]) and any(trial.push[3:])


@once_a_pose
def in_free_space(pose: Pose) -> bool:
    """Whether nothing is there for the hand to touch."""
    return not pose.task.touches(pose.arm)


@once_a_pose
def turns(pose: Pose) -> np.ndarray:
    """Return the rotation vector [rad] from start to end of each of a pose's k episodes, k x 3, base frame."""
    return rotation_vector(np.array([one.R[-1] @ one.R[0].T for one in pose.responses]))


@once_a_pose
def compliance(pose: Pose) -> np.ndarray:
    """C [rad/(N m)], 3 x 3: C[i, j] is the rotation about i per moment about j at the end of the episodes."""
    ran = pose.responses
    if not all(one.outcome == "done" and is_moment(one.trial) for one in ran) or not in_free_space(pose):
        return NOTHING
    moments = np.array([one.trial.push[3:] for one in ran])
    transposed, _, rank, _ = np.linalg.lstsq(moments, turns(pose), rcond=None)
    return transposed.T if rank == 3 else NOTHING


def held(pose: Pose) -> np.ndarray:
    """Return for the axes x, y, z whether the specification forbids the hand to turn about them."""
    return np.array(pose.first.trial.specification.selection[3:]) == 1


def complying(pose: Pose) -> np.ndarray:
    """Return for the axes x, y, z whether the hand must comply about them; with an impedance about all."""
    if pose.controller.impedance is not None:
        return np.ones(3, bool)
    return ~held(pose)


def among_complying(pose: Pose) -> np.ndarray:
    """C [rad/(N m)] among the k axes that comply, k x k."""
    complies = complying(pose)
    return compliance(pose)[np.ix_(complies, complies)]


def is_still(yields: np.ndarray) -> np.ndarray:
    """Return whether each of k rotations per moment [rad/(N m)], columns of a matrix, is zero."""
    return np.linalg.norm(yields, axis=0) < STILL


def misaligned(C: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Angles [rad] between those of the axes x, y, z that count and C e [rad/(N m)]; NaN where C e is no rotation."""
    along = np.diag(C)
    across = np.linalg.norm(C - np.diag(along), axis=0)
    return np.where(is_still(C), np.nan, np.arctan2(across, along))[axes]

"""Starts of arms looked at with scipy's rotations: the way to their goals, walked again."""

import math

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

import tasks
from support.states import rotation
from tasks.kinematics import kinematics
from tasks.paths import geodesic as evenly_turned

ARMS = tasks.arm_names()
BETWEEN = 1.05
"""A bound was looked at every five degrees; between these points a condition number can be a little larger."""


def turned_in_place(model, q, axis, angle, steps):
    """Joint path, (steps + 1) x n, that turns the tool by an angle about a base-frame axis; None if it ends early."""
    return model.follow(q, evenly_turned(model.pose(q)[1], axis, angle, steps))


def geodesic(start, points):
    """Rotations along the shortest way from start to goal, at these shares of it."""
    return Slerp([0.0, 1.0], Rotation.concatenate([rotation(start.quat_wxyz), rotation(start.goal_wxyz)]))(points)


def straight(start, points):
    """Rotations whose Z-Y-X angles go straight from those of the start to those of the goal."""
    first, last = (rotation(quat).as_euler("ZYX") for quat in (start.quat_wxyz, start.goal_wxyz))
    return Rotation.from_euler("ZYX", first + np.outer(points, last - first))


def evenly(start):
    return np.linspace(0.0, 1.0, 2 + int(math.degrees(angle_of(start)) / 2.0))


def angle_of(start):
    return (rotation(start.goal_wxyz).inv() * rotation(start.quat_wxyz)).magnitude()


def cos_beta(rotations):
    return np.hypot(*rotations.as_matrix()[..., :2, 0].T)


def walked(arm, start, rotations):
    """The joint path, which must be there to the end."""
    quats = [tuple(quat) for quat in rotations.as_quat(scalar_first=True).tolist()]
    path = kinematics(tasks.arm(arm)).follow(start.q, quats)
    assert path is not None, start.id
    return path


def conditions(arm, path):
    model = kinematics(tasks.arm(arm))
    return np.array([np.linalg.cond(model.jacobian(q)) for q in path])


def in_range(arm, path, margin=0.0):
    one = tasks.arm(arm)
    return bool(((np.array(one.lower) + margin <= path) & (path <= np.array(one.upper) - margin)).all())

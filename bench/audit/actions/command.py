"""`actions`: what the rotation of logged actions means, and whether that is what was stated."""

import argparse
from pathlib import Path
from typing import Any

from bench.audit.actions.log import EPISODES, NEXT, POSES, find_column, read_arrays, read_poses
from bench.audit.actions.report import audit_actions

DESCRIPTION = """\
Find what the rotation in the actions of a log means: rotation vector, Euler angles, quaternion or matrix; a goal, or
a turn from the current pose in the base or body frame; its scale. The poses before and after each action decide it."""
EPILOG = """\
Arrays R (n x 3 x 3), action and, with several episodes, episode_index:
   {prog} log.npz
Numbers 3, 4, 5 of two columns; the poses are rotation vectors:
   {prog} log.parquet --pose observation.state[3:6]:rotation-vector --action action[3:6]
Check what the robot's manual says:
   {prog} log.npz --expect "rotation-vector base scale=0.5"

A column is NAME, NAME[3:6] or NAME[3:6]:READING; readings are rotation-vector, euler-xyz, quaternion-wxyz and others.
Exit code 1: not what was expected, or a fault. Exit code 2: nothing explains the log."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Describe the options to a parser."""
    add = parser.add_argument
    add("log", type=Path, metavar="LOG", help="a .npz or .parquet file with one row for each step")
    add("--pose", metavar="COLUMN", help=f"pose before the action; default: the first of {', '.join(POSES)}")
    add("--action", metavar="COLUMN", default="action", help="three to nine numbers of the rotation; default: action")
    add("--next", metavar="COLUMN", help="pose after the action; default: the pose of the next row")
    add("--episode", metavar="COLUMN", help=f"default: {' or '.join(EPISODES)}; without it the log is one episode")
    add("--expect", metavar="WORDS", default="", help="what it should be, in words as in the last example")


def run(arguments: argparse.Namespace) -> tuple[int, str, dict[str, Any]]:
    """Return the exit code of the audit of a log, and its report as text and for JSON."""
    arrays = read_arrays(arguments.log)
    poses = read_poses(*find_column(arrays, arguments.pose, POSES))
    has_next = arguments.next or any(one in arrays for one in NEXT)
    following = read_poses(*find_column(arrays, arguments.next, NEXT)) if has_next else None
    has_episodes = arguments.episode or any(one in arrays for one in EPISODES)
    episode = find_column(arrays, arguments.episode, EPISODES)[0][:, 0] if has_episodes else None
    report = audit_actions(poses, find_column(arrays, arguments.action)[0], following, episode, expect=arguments.expect)
    return report.code, report.text(), report.as_dict()

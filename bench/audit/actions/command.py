"""`audit actions`: what the rotation of logged actions means, and whether that is what was stated."""

import argparse
import json
from pathlib import Path

from bench.audit.actions.log import EPISODES, NEXT, POSES, find_column, read_arrays, read_poses
from bench.audit.actions.report import audit_actions

EPILOG = """examples:
  audit actions log.npz                              arrays R (n x 3 x 3), action, perhaps episode_index
  audit actions file-000.parquet --pose observation.state[3:6]:rotation-vector --action action[3:6]
  audit actions log.npz --action action[3:6] --expect "rotation-vector base scale=0.5"

exit code: 0 found, and as stated; 1 found, but not as stated or with a fault; 2 nothing explains the log."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.formatter_class, parser.epilog = argparse.RawDescriptionHelpFormatter, EPILOG
    parser.add_argument("log", type=Path, metavar="LOG", help="a file .npz or .parquet with a row for every step")
    column = "column as NAME, NAME[3:6] or NAME[3:6]:READING (rotation-vector, quaternion-wxyz, euler-xyz ...)"
    parser.add_argument("--pose", help=f"{column}; default: the first of {', '.join(POSES)}")
    parser.add_argument("--action", default="action", help="the three to nine numbers of the rotation; default: action")
    parser.add_argument("--next", help="the pose after the action; default: the pose of the next row of the episode")
    parser.add_argument("--episode", help=f"default: {' or '.join(EPISODES)}, or all rows are one episode")
    parser.add_argument("--expect", default="", metavar="WORDS", help="what is stated: representation, base, body, ...")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all of the result for machines")


def run(arguments: argparse.Namespace) -> int:
    """Audit a log, print the report, and return the exit code."""
    arrays = read_arrays(arguments.log)
    poses = read_poses(*find_column(arrays, arguments.pose, POSES))
    has_next = arguments.next or any(one in arrays for one in NEXT)
    following = read_poses(*find_column(arrays, arguments.next, NEXT)) if has_next else None
    has_episodes = arguments.episode or any(one in arrays for one in EPISODES)
    episode = find_column(arrays, arguments.episode, EPISODES)[0][:, 0] if has_episodes else None
    report = audit_actions(poses, find_column(arrays, arguments.action)[0], following, episode, expect=arguments.expect)
    print(report.text(), end="")
    if arguments.json:
        arguments.json.write_text(json.dumps(report.as_dict(), indent=1) + "\n", encoding="utf-8")
    return report.code

"""Pegs of several fits, run to rest: how deep, and what holds those that stick."""

import math
from collections.abc import Iterator

import numpy as np

import tasks
from bench.engines.contact_episode import FORCE, MOMENT, USUAL, Ended
from bench.engines.metrics.contact.rest import remaining_speed
from bench.engines.metrics.contact.scene import IN, insertion_depth
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.simulate_contact import run_contact as run
from bench.findings.theory import jamming
from bench.law.control.registry import find_controller
from tasks.contact import Trial
from tasks.contact_model import STANDARD
from tasks.domains.peg_in_hole import CHAMFER, PEG, with_clearance
from tasks.rotations import columns

ARM = "ur5e"
CONTROLLERS = {"hybrid-base+transpose": (0,), "hybrid/zyx-euler+transpose": (45, 75)}
"""With the betas [deg] that each is asked at; the first does not know of them."""
CLEARANCES = (0.02, 0.005, 0.001)
TIGHT = STANDARD._replace(stiffness=1e7, damping=2e4)
"""Stiff enough for the closest fit: 30 N press it in by 3 micrometres, of 12.5 on each side."""
TIGHT_DT_S = 2e-4
"""What TIGHT takes to be stepped: a fifth of its time constant."""


def fits() -> list[dict]:
    """Return a row an episode of each clearance, on contacts that are stiff beside it."""
    return [{"clearance": share, **row} for share in CLEARANCES for row in episodes(share)]


def episodes(share: float) -> Iterator[dict]:
    """Every hole by every controller: depth [m], speed at the end [m/s], and the load in both planes of the hole."""
    task, arm = with_clearance(share), tasks.arm(ARM)
    conditions = USUAL._replace(dt_s=TIGHT_DT_S)
    for name, betas in CONTROLLERS.items():
        one = find_controller(name)
        trials = [each for each in task.trials(arm) if int(each.id.rpartition("beta")[2]) in betas]
        for trial, ended in zip(trials, run("native", one, task, arm, trials, conditions, TIGHT), strict=True):
            pose = Pose(task, arm, one, (response(trial, ended),))
            depth = insertion_depth(pose)
            yield {
                "controller": name,
                "trial": trial.id,
                "outcome": ended.outcome,
                "rested": ended.rested,
                "depth_m": depth,
                "speed_m_per_s": remaining_speed(pose),
                **(load(trial, ended, depth - CHAMFER, TIGHT.friction) if IN > depth > CHAMFER else {}),
            }


def load(trial: Trial, ended: Ended, inside: float, mu: float) -> dict:
    """Return the hand's final push on the peg, in the plane of the hole in which it is further from sliding.

    inside: how far the peg is between the walls [m]: in the chamfer nothing jams it.
    """
    into = np.array(columns(trial.scene_wxyz))
    force, moment = (-into @ ended.record[-1, k : k + 3] for k in (FORCE, MOMENT))
    inwards, reach = -float(force[2]), inside / (2.0 * PEG * mu)
    planes = [(float(force[0]), float(moment[1])), (float(force[1]), -float(moment[0]))]
    loads = [(x / inwards, m / (PEG * inwards)) for x, m in planes] if inwards > 0.0 else [(math.nan, math.nan)]
    across, turning = max(loads, key=lambda one: jamming.margin(one[0], one[1], reach, mu))
    return {
        "across": across,
        "turning": turning,
        "lambda": reach,
        "margin": jamming.margin(across, turning, reach, mu),
    }

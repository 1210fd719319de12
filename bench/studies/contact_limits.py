"""Do plates, pegs, cranks and planes end otherwise with motors that are cut and a real force sensor? results/contact.

Each setting adds to the one before: ideal motors and a sensor without noise, as in the default run; motors that give at
most their rated torque; a wrist sensor's reading at 100 Hz with noise. The arms have no stops and no motor inertia
beyond their files'. A call that was stopped goes on with the settings that are missing.
"""

import functools

import pandas as pd

import tasks
from bench.engines.contact_episode import Conditions, Sensor
from bench.experiments.contact import can_do, controllers_and_poses, frame, poses_of
from bench.experiments.suites import SUITES
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import as_table
from bench.law.control.registry import find_controller
from bench.studies.study import make_table

STORED = RESULTS / "contact" / "contact_limits.parquet"
TASKS = ("surface-alignment", "peg-in-hole", "crank", "force-on-plane")
CONTROLLERS = ("hybrid-base+transpose", "hybrid/zyx-euler+transpose", "impedance-geometric")
SETTINGS = {
    "ideal": Conditions(),
    "motors": Conditions(is_cut=True),
    "sensor": Conditions(is_cut=True, sensor=Sensor(period_s=0.01, force=0.1, moment=0.005)),
}
"""The sensor's rate and noise are those of sensors for arms like these: Robotiq's FT 300-S streams at 100 Hz."""


def run_setting(setting: str) -> list[dict]:
    """Return a row a pose of every task, arm and controller that the quick suite has."""
    section, found = SUITES["quick"].sections["contact"], []
    for word in TASKS:
        task = tasks.contact_task(word)
        for arm in map(tasks.arm, tasks.arm_names()):
            controllers, count = controllers_and_poses(section, arm.joints)
            for one in map(find_controller, CONTROLLERS):
                if can_do(task, arm) and one.name in controllers:
                    poses = poses_of(one, task, arm, dense=False)[:count]
                    found.append(frame("study", one, task, arm, poses, SETTINGS[setting]).assign(setting=setting))
    return as_table(pd.concat(found), "contact_limits").to_pylist()


def main() -> None:
    """Run the study, or go on."""
    make_table("contact_limits", __doc__, STORED, {one: functools.partial(run_setting, one) for one in SETTINGS})


if __name__ == "__main__":
    main()

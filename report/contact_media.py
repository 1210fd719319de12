"""Pictures of the tasks in contact for the report: a still of each, and a loop on the tilted plate.

An episode's record holds the hand's place and orientation tick by tick; the joint angles follow from them, by Newton's
method from one frame to the next, and the scene's joint is in the record.
"""

from __future__ import annotations

from contextlib import closing

from drawing import HALF, LINE, Motion, View, loop, save, sheet, written

ARM = "puma560"
SHOWN = {
    "surface-alignment": ("tilt 20 about 120, beta+0", 0.5),
    "peg-in-hole": ("tilt 8 about 120, beta+0", 0.32),
    "crank": ("", 0.6),
    "force-on-plane": ("tilt 10 about 35, beta+0", 0.55),
}
"""Task -> the trial of its still, the first one where none is named, and from how far [m] it is seen."""
BY = "hybrid-base+transpose"
STILL_AT_S = 1.5  # the hand is busy then, on every task
PLATE, TILTED = "surface-alignment", "tilt 20 about 0, beta+75"
CONTROLLERS = {"hybrid-base+transpose": "Cartesian", "hybrid/zyx-euler+transpose": "Euler, β = 75°"}
LOOP_S, SLOWER = 2.4, 1.2
NEWTON_STEPS = 6  # from one frame to the next the hand moves by centimetres at most, and each step squares what is left


def seen(task: str, trial: str, controller: str) -> tuple[Puppet, Motion]:
    """One episode by the compiled engine, its record's lines, and a puppet at its beginning."""
    import tasks
    from bench.engines.contact_episode import USUAL
    from bench.engines.simulate_contact import run_contact as run
    from bench.law.control.registry import find_controller

    arm, about = tasks.arm(ARM), tasks.contact_task(task)
    one = next(each for each in about.trials(arm) if each.id == trial or not trial)
    ended = next(run("native", find_controller(controller), about, arm, (one,)))
    return Puppet(task, one), Motion(USUAL.dt_s, ended.record)


class Puppet:
    """A task on the arm, the scene, the hand's frame and the joints where a trial has them at first."""

    def __init__(self, task: str, trial):
        import mujoco

        import tasks
        from bench.engines.contact_episode import USUAL
        from tasks.contact import prepare
        from tasks.contact_model import model_xml

        self.joints = tasks.arm(ARM).joints
        xml = model_xml(tasks.contact_task(task), tasks.arm(ARM), USUAL.dt_s)
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)
        prepare(self.model, self.data, trial)
        mujoco.mj_forward(self.model, self.data)

    def follow(self, line) -> None:
        """Move the joints so that the hand is where a line of the record has it."""
        import mujoco
        import numpy as np

        from bench.engines.contact_episode import TURNED, P, R

        model, data, n = self.model, self.data, self.joints
        site = model.site("hand").id
        goal, J = line[R : R + 9].reshape(3, 3).T, np.zeros((6, model.nv))
        if model.nv > n:
            data.qpos[n:] = line[TURNED]
        for _ in range(NEWTON_STEPS):
            mujoco.mj_forward(model, data)
            mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
            turn = goal @ data.site_xmat[site].reshape(3, 3).T
            vee = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
            missing = np.concatenate((line[P : P + 3] - data.site_xpos[site], vee))
            data.qpos[:n] += np.linalg.solve(J[:, :n], missing)
        mujoco.mj_forward(model, data)


def view(puppet: Puppet, azimuth: float, elevation: float, distance: float) -> View:
    """Return a view of the place where a puppet's hand begins, from a distance [m]."""
    import mujoco

    model = puppet.model
    of_scene = model.body_rootid[model.geom_bodyid] == model.body("scene").id
    # capsules of the arm are axes of its frames
    model.geom_rgba[(model.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE) & ~of_scene, 3] = 0.0
    camera = mujoco.MjvCamera()
    camera.azimuth, camera.elevation, camera.distance = azimuth, elevation, distance
    camera.lookat[:] = puppet.data.site("hand").xpos
    return View(puppet, HALF, camera)


def tasks_in_contact() -> None:
    """Draw the strip of stills, one a task."""
    width, height = HALF
    strip = sheet(width * len(SHOWN), height + LINE)
    for place, (task, (trial, distance)) in enumerate(SHOWN.items()):
        puppet, motion = seen(task, trial, BY)
        with closing(view(puppet, 160.0, -14.0, distance)) as of_task:
            for line in motion.frames(STILL_AT_S):
                puppet.follow(line)
            strip.paste(of_task.picture(line), (place * width, 0))
        written(strip, (place * width + width // 2, height + LINE - 12), task.replace("-", " "), 24, anchor="ms")
    save(strip, "contact-tasks.png")


def on_the_plate() -> None:
    """Draw the loop: Cartesian and Euler compliance on the same plate, at equal times."""
    shown = {}
    for controller, title in CONTROLLERS.items():
        puppet, motion = seen(PLATE, TILTED, controller)
        shown[title] = view(puppet, 172.0, -5.0, 0.5), motion
    loop("plate-loop", shown, LOOP_S, SLOWER)


def facts() -> dict:
    """Return what the files show."""
    return {
        "arm": ARM,
        "stills": {task: trial for task, (trial, _) in SHOWN.items()},
        "by": BY,
        "plate": {"task": PLATE, "trial": TILTED, "controllers": list(CONTROLLERS), "loop_s": LOOP_S, "slower": SLOWER},
    }

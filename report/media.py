"""Rendered pictures of the arms for the report: stills, short loops, and what they show in numbers. Optional.

    python report/media.py     renders into report/_static/media (needs GL)

Joint angles come from the compiled engine, tick by tick, as in every episode of the results; in contact they follow
from the record's pose of the hand, by Newton's method from one frame to the next. MuJoCo draws offscreen by EGL (or
MUJOCO_GL=osmesa). Where that does not work the committed files stay. Loops need imageio-ffmpeg (the dev extra). The
headline figure is drawn by `report/headline.py`, which needs no GL and is run from here too.
"""

import json
import os
import sys
from typing import Any

if __name__ == "__main__":
    os.environ.setdefault("MUJOCO_GL", "egl")  # which MuJoCo reads when it is imported

import headline
import numpy as np
import three_fates
from drawing import HALF, LINE, MEDIA, THEMES, Motion, Theme, draw_row, encode_loop, make_view, save

import tasks
from bench.base.provenance import describe
from bench.engines.contact_episode import TURNED, USUAL, P, R
from bench.engines.curve import ARM_NUMBERS
from bench.engines.simulate_contact import run_contact
from bench.experiments.experiment import Unit
from bench.experiments.suites import IDEAL_MOTORS, ON_ARM
from bench.law.contenders.registry import find_contender
from bench.law.control.registry import find_controller
from tasks import contact_model
from tasks.arm_model import model_xml
from tasks.contact import prepare

STRIP = (380, 460)  # pixels of an arm at home
POLE: dict[str, Any] = {"arm": "ur5e", "start_set": "pole", "start": "pole-minus-1-k2", "seed": 0}
CONTENDERS = {
    "feedback-linearized/zyx-euler@analytic+solve": "Euler Jacobian",
    "rotation-matrix@geometric+solve": "geometric Jacobian",
}
POLE_LOOP = {"loop_s": 0.7, "slower": 4}  # played in 2.8 s; the band is reached in 0.65 s or so
POSTER_S = 0.18
CLOSE = (0.22, 0.11, 0.95, 0.88)  # what is kept of a view: left, top, right, bottom

CONTACT_ARM, BY = "puma560", "hybrid-base+transpose"
STILLS = {
    "surface-alignment": ("tilt 20 about 120, beta+0", 0.5),
    "peg-in-hole": ("tilt 8 about 120, beta+0", 0.32),
    "crank": ("", 0.6),
    "force-on-plane": ("tilt 10 about 35, beta+0", 0.55),
}
"""Task -> the trial of its still, the first one where none is named, and from how far [m] it is seen."""
STILL_AT_S = 1.5  # the hand is busy then, on every task
PLATE = {"task": "surface-alignment", "trial": "tilt 20 about 0, beta+75"}
CONTROLLERS = {"hybrid-base+transpose": "Cartesian", "hybrid/zyx-euler+transpose": "Euler, β = 75°"}
PLATE_LOOP = {"loop_s": 2.4, "slower": 1.2}
NEWTON_STEPS = 6  # from one frame to the next the hand moves by centimetres at most, and each step squares what is left


class Puppet:
    """A model whose joints are put where a pose, joint angles [rad], has them."""

    def __init__(self, xml: str):
        import mujoco

        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)

    def follow(self, pose: Any) -> None:
        """Take a pose."""
        import mujoco

        self.data.qpos[:] = pose
        mujoco.mj_forward(self.model, self.data)


class ContactPuppet(Puppet):
    """A task on the arm; a pose is a line of an episode's record, which has the hand's pose and the scene's joint."""

    def __init__(self, task: str, trial: Any):
        arm = tasks.arm(CONTACT_ARM)
        super().__init__(contact_model.model_xml(tasks.contact_task(task), arm, USUAL.dt_s))
        self.joints = arm.joints
        prepare(self.model, self.data, trial)
        super().follow(self.data.qpos.copy())

    def follow(self, pose: Any) -> None:
        """Move the joints so that the hand is where the record has it."""
        import mujoco

        model, data, n = self.model, self.data, self.joints
        goal, J = pose[R : R + 9].reshape(3, 3).T, np.zeros((6, model.nv))
        if model.nv > n:
            data.qpos[n:] = pose[TURNED]
        for _ in range(NEWTON_STEPS):
            mujoco.mj_forward(model, data)
            mujoco.mj_jacSite(model, data, J[:3], J[3:], model.site("hand").id)
            turn = goal @ data.site("hand").xmat.reshape(3, 3).T
            vee = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
            missing = np.concatenate((pose[P : P + 3] - data.site("hand").xpos, vee))
            data.qpos[:n] += np.linalg.solve(J[:, :n], missing)
        mujoco.mj_forward(model, data)

    def camera(self, azimuth: float, elevation: float, distance: float) -> Any:
        """Return a camera on the place where the hand begins, from a distance [m]; the axes of frames are hidden."""
        import mujoco

        model = self.model
        of_scene = model.body_rootid[model.geom_bodyid] == model.body("scene").id
        model.geom_rgba[(model.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE) & ~of_scene, 3] = 0.0
        camera = mujoco.MjvCamera()
        camera.azimuth, camera.elevation, camera.distance = azimuth, elevation, distance
        camera.lookat[:] = self.data.site("hand").xpos
        return camera


def simulate_at_pole() -> dict[str, tuple[Motion, dict]]:
    """Return both contenders from the same start: joint angles [rad] tick by tick, and the judge's row."""
    starts = tasks.start_set(POLE["start_set"], None, POLE["seed"], arm=POLE["arm"])
    [start] = [one for one in starts if one.id == POLE["start"]]
    found, first = {}, ARM_NUMBERS.index("q_1")
    for word in CONTENDERS:
        names = find_contender(word).name, "arm-regulation", POLE["arm"], "native", POLE["start_set"]
        unit = Unit("arm", *names, IDEAL_MOTORS, count=1, horizon_s=ON_ARM)
        ticks, row = three_fates.simulate_one(unit, start, POLE_LOOP["loop_s"], ARM_NUMBERS)
        q = ticks[:, first : first + tasks.arm(POLE["arm"]).joints].tolist()
        found[word] = Motion(three_fates.SETTINGS.dt_s, q), row
    return found


def simulate_contact(task: str, trial: str, name: str) -> tuple[ContactPuppet, Motion]:
    """Return a puppet at the beginning of an episode in contact, and the episode's record."""
    arm, about = tasks.arm(CONTACT_ARM), tasks.contact_task(task)
    one = next(each for each in about.trials(arm) if each.id == trial or not trial)
    ended = next(run_contact("native", find_controller(name), about, arm, (one,)))
    return ContactPuppet(task, one), Motion(USUAL.dt_s, ended.record)


def describe_files(rows: dict[str, dict], fates: dict[str, Any]) -> dict[str, Any]:
    """Return what the files show and where they come from."""
    numbers = ("settling_time_s", "failure_time_s", "path_ratio", "peak_torque_ratio", "position_error_m")
    episodes = [{"contender": word, **three_fates.describe_row(row, numbers)} for word, row in rows.items()]
    plate = {**PLATE, "controllers": list(CONTROLLERS), **PLATE_LOOP}
    stills = {task: trial for task, (trial, _) in STILLS.items()}
    return {**POLE, "episodes": episodes, **POLE_LOOP} | {
        "contact": {"arm": CONTACT_ARM, "stills": stills, "by": BY, "plate": plate},
        "fates": fates,
    }


def draw_arms(theme: Theme, motions: dict[str, Motion]) -> None:
    """Draw the arms at home, and the loop of motions at the pole, by contender."""
    arms = {name: tasks.arm(name) for name in tasks.arm_names()}
    views = {name: make_view(Puppet(model_xml(arm, 1e-3)), STRIP, theme, "view") for name, arm in arms.items()}
    homes, titles = [views[name](arm.home) for name, arm in arms.items()], [arm.title for arm in arms.values()]
    save(draw_row(homes, titles, 0, LINE, STRIP[1] + LINE - 12, 28, theme), f"arms{theme.suffix}.png")
    large = make_view(Puppet(model_xml(arms[POLE["arm"]], 1e-3)), HALF, theme, "view", CLOSE)
    both, note = {CONTENDERS[word]: (large, motion) for word, motion in motions.items()}, POLE_LOOP["slower"]
    encode_loop("pole-loop", both, theme, **POLE_LOOP, note=f", played {note} times slower", poster_s=POSTER_S)


def draw_contact(theme: Theme) -> None:
    """Draw a still of each task in contact, and the loop of two controllers at a plate."""
    scenes = [(*simulate_contact(task, trial, BY), distance) for task, (trial, distance) in STILLS.items()]
    seen = [(make_view(one, HALF, theme, one.camera(160.0, -14.0, far)), motion) for one, motion, far in scenes]
    stills = [[view(pose) for pose in motion.frames(STILL_AT_S)][-1] for view, motion in seen]
    titles = [task.replace("-", " ") for task in STILLS]
    save(draw_row(stills, titles, 0, LINE, HALF[1] + LINE - 12, 24, theme), f"contact-tasks{theme.suffix}.png")
    on_plate = {}
    for name, title in CONTROLLERS.items():
        puppet, motion = simulate_contact(**PLATE, name=name)
        on_plate[title] = make_view(puppet, HALF, theme, puppet.camera(172.0, -5.0, 0.5)), motion
    encode_loop("plate-loop", on_plate, theme, **PLATE_LOOP)


def main() -> None:
    """Draw all files, on light and on dark paper; leave them as they are where MuJoCo cannot draw."""
    found, fates = simulate_at_pole(), three_fates.simulate_fates()
    try:
        for theme in THEMES:
            draw_arms(theme, {word: motion for word, (motion, _) in found.items()})
            draw_contact(theme)
            three_fates.draw(theme, fates)
    except Exception as reason:  # what a missing GL raises depends on the backend
        sys.exit(f"media: not all is drawn here ({reason}; cure where GL is missing: apt-get install libegl1 libgl1)")
    rows = {word: row for word, (_, row) in found.items()}
    about = {"commit": describe()["commit"], **describe_files(rows, three_fates.describe(fates))}
    (MEDIA / "media.json").write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    headline.main()


if __name__ == "__main__":
    main()

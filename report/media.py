"""Rendered pictures of the arms for the report: stills at home, short loops. Optional.

    python report/media.py     renders into report/_static/media (needs GL)

Joint angles come from the compiled engine, tick by tick, as in every episode of the results; MuJoCo draws them
offscreen by EGL (or MUJOCO_GL=osmesa). Where that does not work the committed files stay. The loop needs
imageio-ffmpeg (the dev extra).
"""

from __future__ import annotations

import json
import math
import os
import sys
from contextlib import closing
from pathlib import Path

from drawing import HALF, MEDIA, Motion, View, loop, save, sheet, written

REPORT = Path(__file__).resolve().parent
FACTS = MEDIA / "media.json"

ARM, START_SET, START, SEED = "ur5e", "pole", "pole-minus-1-k2", 0
TASK = "arm-regulation"
CONTENDERS = {
    "feedback-linearized/zyx-euler@analytic+solve": "Euler Jacobian",
    "rotation-matrix@geometric+solve": "geometric Jacobian",
}
LOOP_S, SLOWER = 0.7, 4  # played in 2.8 s; the band is reached in 0.65 s or so
POSTER_S = 0.18

STRIP = (380, 460)  # pixels of an arm at home
CAMERA = "view"  # of an arm's model
CLOSE = (0.22, 0.11, 0.95, 0.88)  # what is kept of it: left, top, right, bottom, as shares of its sides


class Puppet:
    """An arm whose joints are put where a pose has them."""

    def __init__(self, name: str):
        import mujoco

        import tasks
        from tasks.arm_model import model_xml

        self.model = mujoco.MjModel.from_xml_string(model_xml(tasks.arm(name), 1e-3))
        self.data = mujoco.MjData(self.model)

    def follow(self, q) -> None:
        """Take a pose, joint angles [rad]."""
        import mujoco

        self.data.qpos[:] = q
        mujoco.mj_forward(self.model, self.data)


def motions() -> dict[str, tuple[Motion, dict]]:
    """Both contenders from the same start: joint angles [rad] tick by tick, and the judge's row, as of any episode."""
    import numpy as np

    import tasks
    from bench.engines.curve import ARM_NUMBERS, blank_curves
    from bench.experiments.episodes import rows_from, simulate
    from bench.experiments.experiment import Settings, Unit
    from bench.experiments.suites import NOMINAL, ON_ARM
    from bench.findings.claims.probes import controller

    start = next(one for one in tasks.start_set(START_SET, None, SEED, arm=ARM) if one.id == START)
    joints, settings = tasks.arm(ARM).joints, Settings("media")
    found = {}
    for word in CONTENDERS:
        one = controller(word)
        unit = Unit("arm", one.name, TASK, ARM, "native", START_SET, NOMINAL, count=1, horizon_s=ON_ARM)
        curves = blank_curves(1, round(LOOP_S / settings.dt_s), numbers=ARM_NUMBERS)
        simulate(settings, unit, [start], LOOP_S, curves)
        [ticks] = curves.samples
        first = ARM_NUMBERS.index("q_1")
        q = ticks[~np.isnan(ticks[:, 0]), first : first + joints].tolist()
        row = rows_from(settings, unit, [start]).iloc[0].to_dict()
        found[word] = Motion(settings.dt_s, q), row
    return found


def facts(found: dict[str, tuple[Motion, dict]], commit: str) -> dict:
    """Return what the files show and where they come from."""
    numbers = ("settling_time_s", "failure_time_s", "path_ratio", "peak_torque_ratio", "position_error_m")
    episodes = [
        {
            "contender": word,
            "outcome": str(row["outcome"]),
            **{name: None if math.isnan(row[name]) else float(f"{row[name]:.6g}") for name in numbers},
        }
        for word, (_, row) in found.items()
    ]
    place = {"commit": commit, "arm": ARM, "start_set": START_SET, "start": START, "seed": SEED}
    return {**place, "episodes": episodes, "loop_s": LOOP_S, "slower": SLOWER}


def at_home() -> None:
    """Draw the strip of all arms."""
    import tasks

    names, (width, height) = tasks.arm_names(), STRIP
    strip = sheet(width * len(names), height)
    for place, name in enumerate(names):
        arm = tasks.arm(name)
        with closing(View(Puppet(name), STRIP, CAMERA)) as of_arm:
            strip.paste(of_arm.picture(arm.home), (place * width, 0))
        written(strip, (place * width + width // 2, height - 12), arm.title, 28, anchor="ms")
    save(strip, "arms.png")


def main() -> None:
    """Draw all files; leave them as they are where MuJoCo cannot draw."""
    os.environ.setdefault("MUJOCO_GL", "egl")
    sys.path.insert(0, str(REPORT.parent))
    import contact_media

    from bench.base.provenance import describe

    try:
        large = View(Puppet(ARM), HALF, CAMERA, CLOSE)
    except Exception as reason:  # what a missing GL raises depends on the backend
        sys.exit(f"media: nothing is drawn here ({reason}); the files stay (cure: apt-get install libegl1 libgl1)")
    MEDIA.mkdir(parents=True, exist_ok=True)
    found = motions()
    at_home()
    both = {CONTENDERS[word]: (large, motion) for word, (motion, _) in found.items()}
    loop("pole-loop", both, LOOP_S, SLOWER, f", played {SLOWER} times slower", POSTER_S)
    contact_media.tasks_in_contact()
    contact_media.on_the_plate()
    about = {**facts(found, describe()["commit"]), "contact": contact_media.facts()}
    FACTS.write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    kilobytes = sum(path.stat().st_size for path in MEDIA.iterdir()) / 1e3
    print(f"media: {kilobytes:.0f} kB in {MEDIA.relative_to(REPORT.parent)}")


if __name__ == "__main__":
    main()

"""The two processes: the arm, which is this one, and the exported law in `controller.cpp`, in real time at 1 kHz.

The arm moves in SUBSTEPS steps of each control period, each when the clock has reached it. It writes its state at the
first of them, and applies a torque from the first step after the answer on. The operating system decides how late that
is. After a late step the next one follows without a wait. Delays are counted in steps of the simulated arm.
"""

from __future__ import annotations

import ctypes
import mmap
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.export.language import find_language
from bench.export.subject import find_subject
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.truth import haversine

TASK = "arm-regulation"
PERIOD_S = 1e-3
SUBSTEPS = 8
STEP_S = PERIOD_S / SUBSTEPS
MOST = 7
SOURCE = Path(__file__).with_name("controller.cpp")
MUJOCO = Path(mujoco.__file__).parent
INCLUDE = (MUJOCO / "include", "/usr/include/eigen3")
SHARED = np.dtype(
    [
        *((name, "f8", (2, MOST)) for name in ("q", "qdot")),
        *(("R_d", "f8", 9), ("p_d", "f8", 3), ("kp", "f8"), ("kv", "f8"), ("tau", "f8", (2, MOST))),
        *(("tick", "i8"), ("answered", "i8"), ("is_new", "u1", 32)),
    ]
)
"""The fields of `Shared` in controller.cpp; the last is a semaphore of the C library."""
C = ctypes.CDLL(None)


class Course(NamedTuple):
    """Hold an episode: at each tick how far the tool is and how fast, at each step the tick that its torque answers.

    haversine: sin^2(angle/2) to the goal. speed_squared: of the joints [rad^2/s^2]. answered: 0 before the first.
    """

    haversine: np.ndarray
    speed_squared: np.ndarray
    answered: np.ndarray


def build_controller(law: str, folder: Path) -> Path:
    """Export a law to C++, compile its controller in the folder, and return the program."""
    subject = find_subject(law)
    for name, text in find_language("cpp").files(subject).items():
        (folder / name).write_text(text, encoding="utf-8")
    name, program = subject.identifier, folder / f"controller-{subject.identifier}"
    library = next(MUJOCO.glob("libmujoco.so*"))
    words = [f"-DLAW={name}", f'-DHEADER="{name}.hpp"', *(["-DHAS_MEMORY"] if subject.memory else [])]
    includes = [f"-I{path}" for path in (folder, *INCLUDE)]
    link = [str(library), f"-Wl,-rpath,{MUJOCO}", "-lpthread"]
    subprocess.run(["g++", "-O2", "-std=c++17", *words, *includes, SOURCE, "-o", program, *link], check=True)
    return program


class Loop:
    """An arm in real time with its controller; use it in a `with` statement, which ends the other process."""

    def __init__(self, arm: str, variation: str, program: Path):
        one, folder = tasks.arm(arm), program.parent
        self.task, self.joints = tasks.task(TASK, arm), one.joints
        self.model = mujoco.MjModel.from_xml_string(self.task.xml(STEP_S))
        tasks.variation(variation).apply(self.model, one.rated)
        self.data = mujoco.MjData(self.model)
        is_cut = bool(self.model.actuator_ctrllimited.any())
        self.change = one.torque_rate[0] * STEP_S if one.torque_rate and is_cut else np.inf
        model, shared = folder / f"{arm}.mjb", folder / f"{arm}.shared"
        mujoco.mj_saveModel(self.model, str(model), None)
        shared.write_bytes(bytes(SHARED.itemsize))
        with shared.open("r+b") as file:
            self.memory = mmap.mmap(file.fileno(), SHARED.itemsize)
        self.shared = np.frombuffer(self.memory, SHARED)[0]
        self.semaphore = ctypes.c_void_p(self.shared["is_new"].ctypes.data)
        C.sem_init(self.semaphore, 1, 0)
        self.process = subprocess.Popen([program, model, shared])

    def __enter__(self) -> Loop:
        return self

    def __exit__(self, *error: object) -> None:
        self.tell(-1)
        if (code := self.process.wait()) and error[0] is None:
            raise ChildProcessError(f"the controller of {self.task.arm} ended with {code}; no episode of it counts")

    def tell(self, tick: int) -> None:
        """Write the arm's state, and wake the controller."""
        for name, values in (("q", self.data.qpos), ("qdot", self.data.qvel)):
            self.shared[name][tick & 1, : self.joints] = values
        self.shared["tick"] = tick
        C.sem_post(self.semaphore)

    def begin(self, start: Start, gains: Gains) -> None:
        """Place the arm at a start, its torques those that hold it, and tell the controller the goal."""
        data, shared = self.data, self.shared
        mujoco.mj_resetData(self.model, data)
        data.qpos[:], data.qvel[:] = self.task.state(start)
        mujoco.mj_forward(self.model, data)
        data.ctrl[:] = data.qfrc_bias
        mujoco.mju_quat2Mat(shared["R_d"], np.array(start.goal_wxyz))
        shared["p_d"] = start.goal_p or data.site("tool").xpos
        shared["kp"], shared["kv"], shared["answered"] = gains.kp, gains.kv, 0

    def run(self, start: Start, gains: Gains, seconds: float) -> Course:
        """Return the course of an episode, which takes as long on the clock."""
        self.begin(start, gains)
        data, shared, n = self.data, self.shared, self.joints
        ticks = round(seconds / PERIOD_S)
        course = Course(np.zeros(ticks), np.zeros(ticks), np.zeros(ticks * SUBSTEPS, np.int64))
        began = time.perf_counter()
        for step in range(ticks * SUBSTEPS):
            while time.perf_counter() - began < step * STEP_S:
                pass
            tick, rest = divmod(step, SUBSTEPS)
            if rest == 0:
                course.haversine[tick] = haversine(tuple(data.sensor("quat").data.tolist()), start.goal_wxyz)
                course.speed_squared[tick] = data.qvel @ data.qvel
                self.tell(tick + 1)
            answered = int(shared["answered"])
            if answered:
                more = shared["tau"][answered & 1, :n] - data.ctrl
                data.ctrl[:] += np.clip(more, -self.change, self.change)
            course.answered[step] = answered
            mujoco.mj_step2(self.model, data)
            mujoco.mj_step1(self.model, data)
        return course

"""The two processes: the arm (this one, with `arm.cpp`) and the exported law (`controller.cpp`).

The arm moves with the clock and is held exactly between torques: they change at the instant at
which the controller wrote them, whatever the substeps of the simulation. The operating system
decides how late that is. Both processes read the same clock of the system, so that each part of the
delay is known in nanoseconds. `replay` runs an episode again with delays that were recorded,
without a clock.
"""

from __future__ import annotations

import ctypes
import mmap
import subprocess
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.export.language import find_language
from bench.export.subject import find_subject
from bench.findings.real_time import PERIOD_S
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.truth import haversine

TASK = "arm-regulation"
PERIOD_NS = 1_000_000
NS = 1e-9
SUBSTEPS = (8, 16, 64)
"""Steps of the simulated arm in a control period. The study measures that they do not matter."""
MOST_JOINTS = 7
SLOTS = 64
NEVER = -1
FOLDER = Path(__file__).parent
MUJOCO = Path(mujoco.__file__).parent
EIGEN = Path("/usr/include/eigen3")
JOINTS = ("f8", MOST_JOINTS)
STATE = np.dtype([("q", *JOINTS), ("qdot", *JOINTS)])
ANSWER = np.dtype([("tick", "i8"), ("read_ns", "i8"), ("written_ns", "i8"), ("tau", *JOINTS)])
SHARED = np.dtype(
    [
        ("states", STATE, SLOTS),
        ("answers", ANSWER, SLOTS),
        ("R_d", "f8", 9),
        ("p_d", "f8", 3),
        ("kp", "f8"),
        ("kv", "f8"),
        ("episode", "i8"),
        ("tick", "i8"),
        ("answered", "i8"),
        ("is_new", "u1", 32),
    ]
)
"""The fields of `Shared` in shared.hpp; the last is a semaphore of the C library."""
INSTANTS = ("published_ns", "read_ns", "written_ns", "noticed_ns", "applied_ns")
RECORD = np.dtype([("q", *JOINTS), ("qdot", *JOINTS), *((name, "i8") for name in INSTANTS)])
"""The fields of `Record` in arm.cpp."""
C = ctypes.CDLL(None)


class Setting(ctypes.Structure):
    """Hold the fields of `Setting` in arm.cpp."""

    _fields_ = [
        ("ticks", ctypes.c_int64),
        ("substeps", ctypes.c_int64),
        ("period_ns", ctypes.c_int64),
        ("torque_rate", ctypes.c_double),
    ]


class Course(NamedTuple):
    """Hold an episode, tick by tick.

    Attributes:
        haversine: sin^2(angle/2) between tool and goal.
        speed_squared: Of the joints [rad^2/s^2].
        records: Of type RECORD: the arm's state, and the instants of the answer in ns from the
        begin; NEVER if none.
    """

    haversine: np.ndarray
    speed_squared: np.ndarray
    records: np.ndarray

    @property
    def applied_s(self) -> np.ndarray:
        """Return when the torques that answer each tick's state come [s]; NaN if never."""
        applied_ns = self.records["applied_ns"]
        return np.where(applied_ns == NEVER, np.nan, NS * applied_ns)


class Programs(NamedTuple):
    """Hold the compiled files: the controller's program, and the library that moves the arm."""

    controller: Path
    arm: Path


def build_programs(law: str, folder: Path) -> Programs:
    """Export a law to C++, and compile its controller and the arm's library in the folder."""
    subject = find_subject(law)
    for name, text in find_language("cpp").files(subject).items():
        (folder / name).write_text(text, encoding="utf-8")
    programs = Programs(folder / f"controller-{subject.identifier}", folder / "arm.so")
    mujoco_library = next(MUJOCO.glob("libmujoco.so*"))
    includes = [f"-I{path}" for path in (folder, FOLDER, MUJOCO / "include", EIGEN)]
    compiler = ["g++", "-O2", "-std=c++17", "-Wall", *includes]
    link = [str(mujoco_library), f"-Wl,-rpath,{MUJOCO}", "-lpthread"]
    words = [f"-DLAW={subject.identifier}", f'-DHEADER="{subject.identifier}.hpp"']
    if subject.memory:
        words.append("-DHAS_MEMORY")
    controller = [
        *compiler,
        *words,
        str(FOLDER / "controller.cpp"),
        "-o",
        str(programs.controller),
        *link,
    ]
    subprocess.run(controller, check=True)
    arm = [*compiler, "-shared", "-fPIC", str(FOLDER / "arm.cpp"), "-o", str(programs.arm), *link]
    subprocess.run(arm, check=True)
    return programs


class Loop:
    """An arm in real time with its controller, whose process ends with the `with` statement."""

    def __init__(self, arm: str, variation: str, programs: Programs):
        description = tasks.arm(arm)
        self.task = tasks.task(TASK, arm)
        self.joints = description.joints
        # This step matters to the stops of joints alone: our own steps move the arm.
        # None of them is longer.
        self.model = mujoco.MjModel.from_xml_string(self.task.xml(PERIOD_S / min(SUBSTEPS)))
        tasks.variation(variation).apply(self.model, description.rated)
        self.data = mujoco.MjData(self.model)
        is_cut = bool(self.model.actuator_ctrllimited.any())
        self.torque_rate = np.inf
        if description.torque_rate and is_cut:
            self.torque_rate = description.torque_rate[0]
        self.library = ctypes.CDLL(str(programs.arm))
        for function in (self.library.run_in_real_time, self.library.replay):
            function.restype = ctypes.c_bool
        self.library.clock_resolution_ns.restype = ctypes.c_int64
        self._share_memory(programs.controller.parent / f"{arm}.shared")
        model_file = programs.controller.parent / f"{arm}.mjb"
        mujoco.mj_saveModel(self.model, str(model_file), None)
        self.process = subprocess.Popen([programs.controller, model_file, self.shared_file])

    def _share_memory(self, path: Path) -> None:
        path.write_bytes(bytes(SHARED.itemsize))
        with path.open("r+b") as file:
            self.memory = mmap.mmap(file.fileno(), SHARED.itemsize)
        self.shared_file = path
        self.shared = np.frombuffer(self.memory, SHARED)[0]
        self.semaphore = ctypes.c_void_p(self.shared["is_new"].ctypes.data)
        C.sem_init(self.semaphore, 1, 0)

    def __enter__(self) -> Loop:
        return self

    def __exit__(self, *error: object) -> None:
        self.shared["tick"] = -1
        C.sem_post(self.semaphore)
        code = self.process.wait()
        if code and error[0] is None:
            raise ChildProcessError(
                f"the controller of {self.task.arm} ended with {code}; no episode of it counts"
            )

    @property
    def resolution_s(self) -> float:
        """Return the time between two readings of the clock [s]."""
        return NS * self.library.clock_resolution_ns()

    def begin(self, start: Start, gains: Gains) -> None:
        """Place the arm at a start, its torques those that hold it, and share the goal."""
        data, shared = self.data, self.shared
        mujoco.mj_resetData(self.model, data)
        data.qpos[:], data.qvel[:] = self.task.state(start)
        mujoco.mj_forward(self.model, data)
        data.ctrl[:] = data.qfrc_bias
        # The tick first: the controller does nothing as long as it is zero.
        shared["tick"] = 0
        shared["answered"] = 0
        shared["episode"] += 1
        mujoco.mju_quat2Mat(shared["R_d"], np.array(start.goal_wxyz))
        shared["p_d"] = start.goal_p or data.site("tool").xpos
        shared["kp"], shared["kv"] = gains

    def publish(self, tick: int) -> None:
        """Write the arm's state as that of a tick, and wake the controller."""
        state = self.shared["states"][tick % SLOTS]
        state["q"][: self.joints], state["qdot"][: self.joints] = self.data.qpos, self.data.qvel
        self.shared["tick"] = tick
        C.sem_post(self.semaphore)

    def run(self, start: Start, gains: Gains, seconds: float, substeps: int) -> Course:
        """Return the course of an episode, which takes as long on the clock."""
        setting = self._setting(round(seconds / PERIOD_S), substeps)
        records = np.zeros(setting.ticks, RECORD)
        self.begin(start, gains)
        is_answered = self.library.run_in_real_time(*self._addresses(setting, records))
        return self._course(start, records, is_answered)

    def replay(self, start: Start, gains: Gains, applied_ns: np.ndarray, substeps: int) -> Course:
        """Return the course of an episode whose torques arrive when they did in another one.

        applied_ns: of each tick; NEVER where its state was not answered.
        """
        setting = self._setting(len(applied_ns), substeps)
        records = np.zeros(setting.ticks, RECORD)
        instants = np.ascontiguousarray(applied_ns, np.int64)
        self.begin(start, gains)
        address = ctypes.c_void_p(instants.ctypes.data)
        is_answered = self.library.replay(*self._addresses(setting, records), address)
        return self._course(start, records, is_answered)

    def _setting(self, ticks: int, substeps: int) -> Setting:
        return Setting(ticks, substeps, PERIOD_NS, self.torque_rate)

    def _addresses(self, setting: Setting, records: np.ndarray) -> tuple:
        return (
            ctypes.c_void_p(self.model._address),
            ctypes.c_void_p(self.data._address),
            ctypes.c_void_p(self.shared["states"].ctypes.data),
            ctypes.byref(setting),
            ctypes.c_void_p(records.ctypes.data),
        )

    def _course(self, start: Start, records: np.ndarray, is_answered: bool) -> Course:
        if not is_answered:
            raise ChildProcessError(
                f"the controller of {self.task.arm} does not answer; no episode of it counts"
            )
        data, quat = self.data, np.zeros(4)
        site = self.model.site("tool")
        haversines = np.zeros(len(records))
        for tick, q in enumerate(records["q"]):
            data.qpos[:] = q[: self.joints]
            mujoco.mj_kinematics(self.model, data)
            mujoco.mju_mulQuat(quat, data.xquat[site.bodyid[0]], site.quat)
            haversines[tick] = haversine(tuple(quat.tolist()), start.goal_wxyz)
        speeds = records["qdot"][:, : self.joints]
        return Course(haversines, np.einsum("ij,ij->i", speeds, speeds), records)

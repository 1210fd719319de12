"""libmujoco's C functions for compiled code, where addresses and pointers are plain integers.

They are called by their symbols, which the disk cache keeps; ctypes pointers it would not.
"""

from pathlib import Path

import llvmlite.binding as llvm
import mujoco
from numba import types

llvm.load_library_permanently(str(next(Path(mujoco.__file__).parent.glob("libmujoco.so*"))))

MUJOCO_INTEGRATORS = {
    "euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "rk4": mujoco.mjtIntegrator.mjINT_RK4,
}


def _c_function(name: str, pointers: int):
    return types.ExternalFunction(name, types.void(*[types.intp] * pointers))


mj_resetData = _c_function("mj_resetData", 2)
mj_step = _c_function("mj_step", 2)
mj_step1 = _c_function("mj_step1", 2)
mj_step2 = _c_function("mj_step2", 2)
mj_fwdActuation = _c_function("mj_fwdActuation", 2)
mj_forward = _c_function("mj_forward", 2)
mj_fullM = _c_function("mj_fullM", 3)

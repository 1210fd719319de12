"""libmujoco's C functions for compiled code, where addresses and pointers are plain integers.

They are called by their symbols, which the disk cache keeps; ctypes pointers it would not.
"""

import ctypes
from pathlib import Path

import llvmlite.binding as llvm
import mujoco
from numba import types

_LIBRARY = str(next(Path(mujoco.__file__).parent.glob("libmujoco.so*")))

llvm.load_library_permanently(_LIBRARY)

library = ctypes.CDLL(_LIBRARY)
"""For what the Python bindings have not."""

ctypes.c_void_p.in_dll(library, "mjcb_time").value = None
"""The bindings' clock, which MuJoCo asks again and again in a step for timers that nobody reads: 14 to 34 % of it."""

_WORDS = ("euler", "implicit", "implicitfast", "rk4")
MUJOCO_INTEGRATORS = {word: getattr(mujoco.mjtIntegrator, f"mjINT_{word.upper()}") for word in _WORDS}


def library_function(name: str, *arguments: types.Type) -> types.ExternalFunction:
    """Return a C function by its name for compiled code; it takes a model and data where no arguments are named."""
    return types.ExternalFunction(name, types.void(*(arguments or (types.intp, types.intp))))


mj_resetData = library_function("mj_resetData")
mj_step = library_function("mj_step")
mj_step1 = library_function("mj_step1")
mj_step2 = library_function("mj_step2")
mj_fwdActuation = library_function("mj_fwdActuation")
mj_forward = library_function("mj_forward")
mj_fullM = library_function("mj_fullM", types.intp, types.intp, types.intp)


def model_of(xml: str, integrator: str) -> mujoco.MjModel:
    """Return the model of an MJCF text without visual geoms: they cost up to a fifth of a step and change no bit."""
    text = mujoco.MjSpec.from_string(xml)
    text.compiler.discardvisual = True
    model = text.compile()
    model.opt.integrator = MUJOCO_INTEGRATORS[integrator]
    return model


def skip_constraints(model: mujoco.MjModel) -> mujoco.MjModel:
    """Switch off the constraints of a model that can have none: they cost up to a sixth of a step and change no bit."""
    off, flags = mujoco.mjtDisableBit, model.opt.disableflags
    can_touch = model.npair or model.geom_contype.any() or model.geom_conaffinity.any()
    can_end = model.jnt_limited.any() or model.tendon_limited.any()
    if not (
        (can_touch and not flags & off.mjDSBL_CONTACT)
        or (can_end and not flags & off.mjDSBL_LIMIT)
        or model.neq
        or model.nflex
        or model.dof_frictionloss.any()
        or model.tendon_frictionloss.any()
    ):
        model.opt.disableflags |= off.mjDSBL_CONSTRAINT
    return model

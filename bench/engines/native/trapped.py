"""Steps of MuJoCo whose errors come back as a number instead of ending the process.

Outside of its Python bindings an error of MuJoCo's (no room left for its contacts' solver, say) ends the process.
`mjb_apply` runs a function for each simulation of a batch and traps errors in it. The batch here is of one simulation
that is never stepped: what our function steps is whatever its argument says.
"""

import ctypes
import threading
import weakref

import mujoco
from numba import carray, int32, int64, types

from bench.engines.compiled import compile_callback
from bench.engines.in_c import CodeOfCallback, compiler
from bench.engines.mujoco_view import in_compiled_code
from bench.engines.native.libmujoco import library, mj_forward, mj_step, mj_step1, mj_step2
from bench.law.scalar import kernel

BEGIN, STEP, RUNGE_KUTTA = 0, 1, 2

_of_thread = threading.local()

_mjb_apply = types.ExternalFunction(
    "mjb_apply", types.int32(types.intp, types.intp, types.int32, types.intp, types.intp, types.int32)
)
"""Number of failed simulations of mjb_apply(batch, ids, nid, function, argument, save)."""


def _advance(model, data, simulation, asked):
    """Run the request on a model and data: [model, data, BEGIN, STEP or RUNGE_KUTTA]."""
    m, d = asked[0], asked[1]
    if asked[2] == BEGIN:
        mj_forward(m, d)
    elif asked[2] == STEP:
        mj_step2(m, d)
    else:
        mj_step(m, d)
    mj_step1(m, d)


_kernel_of_callback = kernel(_advance)


def _advance_by_address(model, data, simulation, argument):
    _kernel_of_callback(model, data, simulation, carray(argument, (3,)))


_callback = (
    CodeOfCallback(_advance)
    if compiler()
    else compile_callback(_advance_by_address, types.void(types.intp, types.intp, int32, types.CPointer(int64)))
)

CALLBACK = _callback.address


def advance_trapped(body):
    """Return the errors, 0 or 1, of one step by body.asked (`_advance`); plain, of dm_control's environment."""
    if body.asked[2] != BEGIN:
        try:
            body.sim.data.step(body.sim.ctrl.copy())
        except mujoco.FatalError as error:
            _of_thread.said = str(error)
            return 1
    return 0


@in_compiled_code(advance_trapped)
def _advance_trapped(body):
    return _mjb_apply(body.batch, 0, 1, body.callback, body.asked.ctypes.data, 0)


class _Config(ctypes.Structure):
    _fields_ = (("nthread", ctypes.c_int), ("persistent", ctypes.c_bool))


library.mjb_makeBatch.restype = ctypes.c_void_p
library.mjb_makeBatch.argtypes = (ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int)
library.mjb_deleteBatch.argtypes = (ctypes.c_void_p,)
library.mjb_error.restype = ctypes.c_char_p
library.mjb_error.argtypes = (ctypes.c_void_p, ctypes.c_int)


class Batch:
    """A batch of one simulation for one thread; `address` is what `step` takes."""

    def __init__(self) -> None:
        self._model = mujoco.MjModel.from_xml_string("<mujoco/>")
        self.address = library.mjb_makeBatch(self._model._address, 1, ctypes.byref(_Config(1, False)), None, 0)
        weakref.finalize(self, library.mjb_deleteBatch, self.address)

    def error(self) -> str:
        """Return what MuJoCo said in the last step that failed."""
        return library.mjb_error(self.address, 0).decode()


def batch() -> Batch:
    """Return the batch of this thread."""
    if not hasattr(_of_thread, "batch"):
        _of_thread.batch = Batch()
    return _of_thread.batch


def said() -> str:
    """Return what MuJoCo said in the last step of this thread that failed and was plain."""
    return getattr(_of_thread, "said", "")

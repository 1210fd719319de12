"""Hold exported short forms to their vectors in NumPy, JAX or PyTorch: python short_forms.py jax FOLDER ..."""

import importlib
import json
import sys
from pathlib import Path

import numpy

LIBRARIES = {"numpy": ("numpy", __name__), "jax": ("jax.numpy", "jax"), "torch": ("torch", "torch.func")}
"""What is imported as np, and the module of its vmap, jit and grad."""


def vmap(function):
    """Call a function of NumPy row by row."""
    return lambda *rows: map(numpy.stack, zip(*map(function, *rows), strict=True))


def hold(library, folder):
    """Return the greatest difference over what is allowed; NaN where a gradient away from 180° is not finite.

    Allowed are 1e-12 of the largest component, and 1e-15, the rounding of R, times (u/kp)^2: some laws divide by zero.
    """
    np, tools = map(importlib.import_module, LIBRARIES[library])
    law, jit = {"np": np}, getattr(tools, "jit", lambda one: one)
    exec(next(folder.glob("short_*.py")).read_text(encoding="utf-8").replace("import numpy as np", ""), law)
    vectors = json.loads((folder / "vectors.json").read_text(encoding="utf-8"))["vectors"]
    rows = [one for one in vectors if one["entry"] == vectors[0]["entry"]]
    R, omega, R_d, gains, *q = (numpy.array([one["arguments"][name] for one in rows]) for name in rows[0]["arguments"])
    given = [np.asarray(one) for one in (R.reshape(-1, 3, 3), omega, R_d.reshape(-1, 3, 3), *gains.T, *q)]
    act = law["angular_acceleration"] if q else lambda *one: (law["angular_acceleration"](*one),)
    u, *kept = map(numpy.asarray, jit(tools.vmap(act))(*given))
    expected, memory = (numpy.array([one[name] for one in rows]) for name in ("result", "memory"))
    top = abs(expected).max(axis=1)
    ratios = [abs(u - expected).max(axis=1) / top / (1e-12 + 1e-15 * (top / gains[:, 0]) ** 2)]
    ratios += [abs(one - memory / numpy.linalg.norm(memory, axis=1)[:, None]) / 1e-12 for one in kept]
    is_away = numpy.array([one["kind"] != "at 180°" for one in rows])
    for at in (given[0], given[2]) if library != "numpy" else ():
        slopes = jit(tools.vmap(tools.grad(lambda *one: (act(*one)[0] ** 2).sum(), (0, 1))))(at, *given[1:])
        ratios += [0.0 * numpy.asarray(one)[is_away] for one in slopes]
    return numpy.max([one.max() for one in ratios])


if __name__ == "__main__":
    print(json.dumps({folder: hold(sys.argv[1], Path(folder)) for folder in sys.argv[2:]}))

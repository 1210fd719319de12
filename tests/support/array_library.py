"""Exported laws on the arrays of another library, in an interpreter of its own: python -I array_library.py jax FOLDER

FOLDER has laws/NAME.py, and states.json with R, omega, R_d and memory. Printed as JSON, by law: the command as the
library asks it (u, and with jit and vmap), and the gradient of the sum of the command by R and omega.
"""

import importlib
import json
import sys
from pathlib import Path

import numpy as np

KP, KV = 100.0, 20.0


def with_jax(law, states: dict) -> dict:
    """By jax.jit, jax.vmap and jax.grad."""
    import jax

    jax.config.update("jax_enable_x64", True)
    given = {name: jax.numpy.asarray(value) for name, value in states.items()}

    def command(R, omega, R_d, *memory):
        answer = law.command(R, omega, R_d, KP, KV, *memory)
        return answer[0] if memory else answer

    inputs = given.values()
    slopes = jax.grad(lambda *each: command(*each).sum(), argnums=(0, 1))
    by_R, by_omega = slopes(*inputs)
    ways = {"u": command, "jit": jax.jit(command), "vmap": jax.vmap(command)}
    return {name: way(*inputs) for name, way in ways.items()} | {"by_R": by_R, "by_omega": by_omega}


def with_torch(law, states: dict) -> dict:
    """By torch.func.vmap and backward()."""
    import torch

    given = {name: torch.tensor(value, requires_grad=name in ("R", "omega")) for name, value in states.items()}

    def command(R, omega, R_d, *memory):
        answer = law.command(R, omega, R_d, KP, KV, *memory)
        return answer[0] if memory else answer

    u = command(*given.values())
    u.sum().backward()
    slopes = {"by_R": given["R"].grad, "by_omega": given["omega"].grad}
    return {"u": u.detach(), "vmap": torch.func.vmap(command)(*given.values()).detach(), **slopes}


def main(library: str, folder: Path) -> None:
    """Every law of the folder."""
    sys.path.insert(0, str(folder / "laws"))
    states = {name: np.array(rows) for name, rows in json.loads((folder / "states.json").read_text()).items()}
    found = {}
    for path in sorted((folder / "laws").glob("*.py")):
        law = importlib.import_module(path.stem)
        given = states if hasattr(law, "START") else {name: states[name] for name in ("R", "omega", "R_d")}
        answers = {"jax": with_jax, "torch": with_torch}[library](law, given)
        found[path.stem] = {name: np.asarray(one).tolist() for name, one in answers.items()}
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))

"""The laws of this benchmark, and errors of controllers that are restated here."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library, Tested, library

RESTATED = {
    "franka_ros": "franka-ros",
    "deoxys_control": "deoxys",
    "serl_franka_controllers": "serl-franka",
    "Isaac Gym idiom": "isaac-gym",
    "crisp_controllers": "crisp",
    "cartesian_controllers": "fzi-motion",
}
"""Name in the tables -> word of bench/law/contenders/shipped."""


@library("orientation-bench", name="orientation-bench")
def orientation_bench() -> Iterator[Tested]:
    """Yield laws on R of this benchmark at rest, with kp = 1 and so the error itself."""
    from bench.law.contenders.registry import find_contender
    from bench.law.inputs import AT_REST, Gains, Goal
    from bench.law.so3 import IDENTITY, Rotation

    def error(law: Callable, R: np.ndarray) -> np.ndarray:
        return np.array(law(IDENTITY, AT_REST, Goal(Rotation(*map(tuple, R.T))), Gains(kp=1.0, kv=0.0)))

    forms = {
        "rotation-vector": "rotation-vector",
        **dict.fromkeys(("square-root", "quaternion-shortest"), "sine-of-half"),
        **{"mrp": "mrp", "rotation-matrix": "sine"},
    }
    for word, form in forms.items():
        yield Function(word, MATRIX, partial(error, find_contender(word).law), form)


def shipped() -> list[Library]:
    """Return errors of controllers that cannot be installed here, by repository and commit, at the suite's gains."""
    from bench.law.contenders.registry import contenders

    def restate(name: str, word: str) -> Library:
        one = contenders("shipped")[word]
        repository, _, revision = one.source.partition("@")
        function = Function("orientation error", QUATERNION, lambda q: one.error(tuple(q.tolist())))
        return Library(name, f"{repository}@{revision[:8]}", (function,), is_restated=True)

    return [restate(*words) for words in RESTATED.items()]

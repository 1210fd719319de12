"""Controllers that cannot be installed here: their orientation errors, as bench/law/contenders/shipped restates them.

Here they run with the gains of the suite, so that what differs is the error; with those of their authors the experiment
`shipped` runs them.
"""

from bench.law.contenders.registry import known_shipped
from bench.studies.libraries.library import QUATERNION, Function, Library

ASKED = {
    "franka_ros": "franka-ros",
    "deoxys_control": "deoxys",
    "serl_franka_controllers": "serl-franka",
    "Isaac Gym idiom": "isaac-gym",
    "crisp_controllers": "crisp",
    "cartesian_controllers": "fzi-motion",
}
"""Name in the tables -> word of bench/law/contenders/shipped."""


def restated(name: str, word: str) -> Library:
    """A controller by its repository and the commit that was read."""
    one = known_shipped()[word]
    repository, _, revision = one.source.partition("@")
    function = Function("orientation error", QUATERNION, lambda quat_wxyz: one.error(tuple(quat_wxyz.tolist())))
    return Library(name, f"{repository}@{revision[:8]}", (function,), is_restated=True)


LIBRARIES = tuple(restated(name, word) for name, word in ASKED.items())

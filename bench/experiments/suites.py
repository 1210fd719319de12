"""Suites: what suites.toml declares as plans; its lists of contenders, controllers and start sets."""

import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

from bench.base.errors import UnknownWord

ENGINES = ("ideal-rk4", "ideal-held", "native", "reference")

LONG, SHORT = 20.0, 10.0
"""Horizons [s]. SHORT is 17 settling times of a small error. LONG is for starts near 180°: rounding (1e-16)
grows there by a decade every 0.56 s, so that what has not left after 10 s of it never will."""

ON_ARM = 5.0
"""Horizon on arms [s]: eight settling times of a small error. What has not settled by then is called timed-out."""

NOMINAL, IDEAL_MOTORS = "nominal", "ideal-motors"
"""Variations of an arm: as it is, and as the paper assumes. The free body has the first alone."""
SLOW = (25.0, 1.0)
"""kp [1/s^2] and damping ratio: half the natural frequency of the paper's gains."""


class Slice(NamedTuple):
    """One engine on one start set; size None is the set's own number."""

    engine: str
    start_set: str
    size: int | None
    horizon_s: float


class OnArms(NamedTuple):
    """The part of a suite that runs on every arm.

    words: contenders as `combinations` writes them, with ideal motors; none at all: every compatible combination. few:
    those of them that run from AT_INVERSES alone. operational: contenders that run with ideal motors and as the arm is,
    from operational_slices alone. compared: the laws that run on the arm as it is, a user's among them; from
    other_slices also with other gains and motors. varied: the contenders of the study of model errors, which runs over
    all variations of the plant. poses: how many an arm's Jacobians are looked at, beside the directed ones.
    """

    words: tuple[str, ...]
    slices: tuple[Slice, ...]
    varied: tuple[str, ...] = ()
    varied_slices: tuple[Slice, ...] = ()
    few: tuple[str, ...] = ()
    operational: tuple[str, ...] = ()
    operational_slices: tuple[Slice, ...] = ()
    compared: tuple[str, ...] = ()
    compared_slices: tuple[Slice, ...] = ()
    other_slices: tuple[Slice, ...] = ()
    poses: int = 0


class InContact(NamedTuple):
    """The part of a suite that runs tasks in contact, on every arm that can do them.

    controllers: their names; none at all: every one. poses: the first so many of each task; None: all. dense: the
    task's dense set of trials instead. in_free_space: laws that take part only where there is nothing to touch.
    in_touch: controllers that take part only where there is something to touch. redundant, redundant_poses: the first
    two on arms of seven joints.
    """

    controllers: tuple[str, ...]
    poses: int | None = None
    dense: bool = False
    in_free_space: tuple[str, ...] = ("hybrid-rate", "hybrid-unconverted")
    in_touch: tuple[str, ...] = ()
    redundant: tuple[str, ...] = ()
    redundant_poses: int | None = None

    def on(self, joints: int) -> tuple[tuple[str, ...], int | None]:
        """Return the controllers and the number of poses of a task on an arm of so many joints."""
        return (self.redundant, self.redundant_poses) if joints > 6 else (self.controllers, self.poses)


class Robustness(NamedTuple):
    """The part of a suite that perturbs laws of the free body, along every axis of tasks/conditions.

    starts: at each level of each axis. others: laws on coordinates that the paper sets aside; None: all of them.
    bounded: the axes along which the laws of BOUNDED run; none at all: every one.
    """

    starts: int
    others: tuple[str, ...] | None = ("feedback-linearized/mrp",)
    bounded: tuple[str, ...] = ()


class Velocity(NamedTuple):
    """Hold the velocity-command experiments of a suite.

    starts: uniform ones of every first-order law on the free body; limited: those with a limiter; on_arms: of each of
    AT_VELOCITIES on each arm.
    """

    starts: int
    limited: int
    on_arms: int


AT_VELOCITIES = ("clear", "uniform")
BY_EVERY_INVERSE = "rotation-vector"
"""The velocity law that is resolved by every inverse: the logarithm, which velocity interfaces take."""
WITHOUT_FACTOR = "quaternion-shortest"
"""The law that is also run at half of K: the quaternion's vector part as it is, without the factor 2."""


class Suite(NamedTuple):
    """A named list of slices, run for every contender that is not only a costing.

    slices: on the free body, of the paper's laws and the user's own; beyond: of later laws, and of laws on coordinates
    that the paper sets aside; in_engine: of MuJoCo's own actuator.
    """

    name: str
    title: str
    slices: tuple[Slice, ...]
    beyond: tuple[Slice, ...]
    traces: int
    boundary_axes: int
    on_arms: OnArms
    in_contact: InContact
    robustness: Robustness
    in_engine: tuple[Slice, ...]
    velocity: Velocity


HORIZON = {"half-turn": LONG, "poles": LONG, "wraps": LONG}

DECLARED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
LISTS: dict[str, tuple[str, ...]] = {name: tuple(words) for name, words in DECLARED.pop("lists").items()}
LAWS, BEST, LATER, BOUNDED, AT_INVERSES = (
    LISTS[name] for name in ("LAWS", "BEST", "LATER", "BOUNDED", "AT_INVERSES")
)
BY_WORD_ALONE = (*LATER, *BOUNDED, *LISTS["BY_WORD_ALONE"])
STREAMED = ("rotation-matrix", *BEST)
"""What follows goals that arrive as a stream: the paper's first law, and the best of later ones."""


def expanded(words: Iterable[str]) -> tuple[str, ...]:
    """Return words, in place of the name of a list its words."""
    return tuple(one for word in words for one in LISTS.get(word, (word,)))


def read_on_arm(start_set: str, size: int | str, horizon_s: float = ON_ARM) -> Slice:
    """Return a slice of an arm; "all" is a set's own number."""
    return Slice("native", start_set, size if isinstance(size, int) else None, horizon_s)


def read_slices(declared: list[list]) -> tuple[Slice, ...]:
    """Return the slices of engines on uniform starts, if there are some, and on the directed ones."""
    found = []
    for engine, uniform, *directed in declared:
        found += [Slice(engine, "uniform", uniform, SHORT)] if uniform else []
        found += [
            Slice(engine, name, None, HORIZON.get(name, SHORT)) for name in expanded(*directed or (["DIRECTED"],))
        ]
    return tuple(found)


def read_on_arms(varied_size: int | str, varied_s: float, poses: int, **said: Any) -> OnArms:
    """Return the part of a suite on arms."""
    slices: dict[str, Any] = {
        f"{part}slices": tuple(read_on_arm(*one) for one in said.pop(f"{part}sizes", {}).items())
        for part in ("", "operational_", "compared_", "other_")
    }
    varied = (read_on_arm("clear", varied_size, varied_s),)
    words: dict[str, Any] = {name: expanded(those) for name, those in said.items()}
    words["compared"] = tuple(f"{name}@geometric+standard" for name in words["compared"])
    return OnArms(varied_slices=varied, poses=poses, **slices, **words)


def read_suite(name: str, declared: dict[str, Any]) -> Suite:
    """Return a suite from its table in suites.toml."""
    said, perturbed = dict(declared), declared["robustness"]
    said |= {part: read_slices(said[part]) for part in ("slices", "beyond", "in_engine")}
    contact: dict[str, Any] = {
        part: expanded(one) if isinstance(one, list) else one for part, one in said["in_contact"].items()
    }
    said["on_arms"], said["in_contact"] = read_on_arms(**said["on_arms"]), InContact(**contact)
    others = {"others": None} if perturbed.get("others") == "all" else {}
    bounded = {"bounded": tuple(perturbed.get("bounded", ()))}
    said["robustness"] = Robustness(**perturbed | others | bounded)
    return Suite(name, **said | {"velocity": Velocity(**said["velocity"])})


SUITES = {name: read_suite(name, declared) for name, declared in DECLARED.items()}


def suite(word: str) -> Suite:
    """Return the suite of that name."""
    if word not in SUITES:
        raise UnknownWord("suite", word, sorted(SUITES))
    return SUITES[word]

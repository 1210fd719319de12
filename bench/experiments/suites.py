"""Suites: which engines run which start sets, how many starts, how long; on arms and in contact also by what."""

from typing import NamedTuple

from bench.base.errors import UnknownWord
from bench.experiments.chosen_words import (
    ANALYTIC,
    BEST,
    COMPLIANT,
    FIRST_FRAMES,
    FIRST_SCENES,
    FIRST_SERIES,
    INVERSES,
    LAWS,
    MORE_COMPLIANT,
    REDUNDANT,
    TWINS,
    VARIED,
)

ENGINES = ("ideal-rk4", "ideal-held", "native", "reference")

LONG, SHORT = 20.0, 10.0
"""Horizons [s]. SHORT is 17 settling times of a small error. LONG is for starts near 180°: rounding (1e-16)
grows there by a decade every 0.56 s, so that what has not left after 10 s of it never will."""

ON_ARM = 5.0
"""Horizon on arms [s]: eight settling times of a small error. What has not settled by then is called timed-out."""

VARIED_S = 2.5
"""Horizon of the study of model errors [s]: four settling times; most of it never settles, and how far off it stays
shows by then."""

NOMINAL = "nominal"
"""The variation in which the plant is the controller's model."""


class Slice(NamedTuple):
    """One engine on one start set; size None is the set's own number."""

    engine: str
    start_set: str
    size: int | None
    horizon_s: float


class OnArms(NamedTuple):
    """The part of a suite that runs on every arm.

    words: contenders as `combinations` writes them; none at all: every compatible combination. few: those of them that
    run from AT_INVERSES alone. varied: the contenders of the study of model errors, which runs over all variations of
    the plant. poses: how many an arm's Jacobians are looked at, beside the directed ones.
    """

    words: tuple[str, ...]
    slices: tuple[Slice, ...]
    varied: tuple[str, ...] = ()
    varied_slices: tuple[Slice, ...] = ()
    few: tuple[str, ...] = ()
    poses: int = 0


class InContact(NamedTuple):
    """The part of a suite that runs tasks in contact, on every arm that can do them.

    controllers: their names; none at all: every one. poses: the first so many of each task; None: all. dense: the
    task's dense set of trials instead. in_free_space: laws that take part only where there is nothing to touch.
    redundant, redundant_poses: the first two on arms of seven joints.
    """

    controllers: tuple[str, ...]
    poses: int | None = None
    dense: bool = False
    in_free_space: tuple[str, ...] = ("hybrid-rate", "hybrid-unconverted")
    redundant: tuple[str, ...] = ()
    redundant_poses: int | None = None

    def on(self, joints: int) -> tuple[tuple[str, ...], int | None]:
        """Return the controllers and the number of poses of a task on an arm of so many joints."""
        return (self.redundant, self.redundant_poses) if joints > 6 else (self.controllers, self.poses)


class Robustness(NamedTuple):
    """The part of a suite that perturbs laws of the free body, along every axis of tasks/conditions.

    starts: at each level of each axis. others: laws on coordinates that the paper sets aside which take part; None:
    all of them.
    """

    starts: int
    others: tuple[str, ...] | None = ("feedback-linearized/mrp",)


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


DIRECTED = ("box", "goals", "half-turn", "paper", "poles", "tumbling", "wraps")
HORIZON = {"half-turn": LONG, "poles": LONG, "wraps": LONG}


def _slices(engine: str, uniform: int, directed: tuple = DIRECTED) -> tuple[Slice, ...]:
    sampled = (Slice(engine, "uniform", uniform, SHORT),) if uniform else ()
    return sampled + tuple(Slice(engine, name, None, HORIZON.get(name, SHORT)) for name in directed)


def _on_arms(**sizes: int | None) -> tuple[Slice, ...]:
    return tuple(Slice("native", name.replace("_", "-"), size, ON_ARM) for name, size in sizes.items())


SUITES = {
    suite.name: suite
    for suite in (
        Suite(
            "quick",
            "the slice that continuous integration reruns and compares",
            _slices("ideal-rk4", 1000)
            + _slices("native", 200, ("half-turn", "paper", "poles"))
            + _slices("reference", 0, ("paper",)),
            _slices("ideal-rk4", 200, ("half-turn", "paper", "poles")),
            traces=12,
            boundary_axes=64,
            on_arms=OnArms(
                (*LAWS, *ANALYTIC, *BEST[:2]),
                _on_arms(clear=4, wrist=4, pole=4, half_turn=4, uniform=4, tumbling=4, reach=4),
                (LAWS[0], ANALYTIC[0]),
                (Slice("native", "clear", 2, VARIED_S),),
                poses=200,
            ),
            in_contact=InContact(COMPLIANT, FIRST_FRAMES, redundant=REDUNDANT[:2], redundant_poses=FIRST_SCENES),
            robustness=Robustness(4),
            in_engine=_slices("native", 200, ("half-turn", "paper", "poles")),
            velocity=Velocity(24, 8, 1),
        ),
        Suite(
            "default",
            "what `make bench` runs and the report shows",
            _slices("ideal-rk4", 1000)
            + _slices("ideal-held", 1000)
            + _slices("native", 250)
            + _slices("reference", 0, ("paper",)),
            _slices("ideal-rk4", 1000) + _slices("native", 100, ("half-turn",)),
            traces=24,
            boundary_axes=128,
            on_arms=OnArms(
                (*LAWS, *ANALYTIC, *TWINS, *INVERSES, *BEST),
                _on_arms(clear=12, wrist=20, pole=32, half_turn=12, uniform=32, tumbling=12, reach=12),
                VARIED,
                (Slice("native", "clear", 4, VARIED_S),),
                (*TWINS, *INVERSES),
                poses=1000,
            ),
            in_contact=InContact((*COMPLIANT, *MORE_COMPLIANT), redundant=REDUNDANT, redundant_poses=FIRST_SERIES),
            robustness=Robustness(24),
            in_engine=_slices("native", 250) + _slices("reference", 0, ("paper",)),
            velocity=Velocity(100, 16, 4),
        ),
        Suite(
            "full",
            "fifty times the uniform starts, and every combination on arms",
            _slices("ideal-rk4", 50_000)
            + _slices("ideal-held", 50_000)
            + _slices("native", 50_000)
            + _slices("reference", 0, ("paper",)),
            _slices("ideal-rk4", 50_000) + _slices("ideal-held", 50_000) + _slices("native", 50_000),
            traces=64,
            boundary_axes=1024,
            on_arms=OnArms(
                (),
                _on_arms(clear=None, wrist=None, pole=None, half_turn=None, uniform=None, tumbling=None, reach=None),
                VARIED,
                (Slice("native", "clear", None, ON_ARM),),
                poses=1000,
            ),
            in_contact=InContact((), dense=True, in_free_space=()),
            robustness=Robustness(1024, None),
            in_engine=_slices("native", 50_000) + _slices("reference", 0, ("paper",)),
            velocity=Velocity(1000, 100, 12),
        ),
    )
}


def suite(word: str) -> Suite:
    """Return the suite of that name."""
    if word not in SUITES:
        raise UnknownWord("suite", word, sorted(SUITES))
    return SUITES[word]

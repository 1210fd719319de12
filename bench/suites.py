"""Suites: which engines run which start sets, how many starts, how long."""

from typing import NamedTuple

from bench.errors import UnknownWord

ENGINES = ("ideal-rk4", "ideal-held", "native", "reference")

LONG, SHORT = 20.0, 10.0
"""Horizons [s]. SHORT is 17 settling times of a small error. LONG is for starts near a half turn: rounding (1e-16)
grows there by a decade every 0.56 s, so that what has not left after 10 s of it never will."""


class Slice(NamedTuple):
    """One engine on one start set; size None is the set's own number."""

    engine: str
    start_set: str
    size: int | None
    horizon_s: float


class Suite(NamedTuple):
    """A named list of slices, run for every contender that is not only a costing."""

    name: str
    title: str
    slices: tuple[Slice, ...]
    traces: int
    boundary_axes: int


DIRECTED = ("box", "goals", "half-turn", "paper", "poles", "tumbling", "wraps")
HORIZON = {"half-turn": LONG, "poles": LONG, "wraps": LONG}


def _slices(engine: str, uniform: int, directed=DIRECTED) -> tuple[Slice, ...]:
    sampled = (Slice(engine, "uniform", uniform, SHORT),) if uniform else ()
    return sampled + tuple(Slice(engine, name, None, HORIZON.get(name, SHORT)) for name in directed)


SUITES = {
    suite.name: suite
    for suite in (
        Suite(
            "quick",
            "the slice that continuous integration reruns and compares",
            _slices("ideal-rk4", 1000)
            + _slices("native", 200, ("half-turn", "paper", "poles"))
            + _slices("reference", 0, ("paper",)),
            traces=24,
            boundary_axes=64,
        ),
        Suite(
            "default",
            "what `make bench` runs and the report shows",
            _slices("ideal-rk4", 5000)
            + _slices("ideal-held", 5000)
            + _slices("native", 5000)
            + _slices("reference", 0, ("paper",)),
            traces=64,
            boundary_axes=256,
        ),
        Suite(
            "full",
            "ten times the uniform starts, for narrower intervals",
            _slices("ideal-rk4", 50_000)
            + _slices("ideal-held", 50_000)
            + _slices("native", 50_000)
            + _slices("reference", 0, ("paper",)),
            traces=64,
            boundary_axes=1024,
        ),
    )
}


def suite(word: str) -> Suite:
    """The suite of that name."""
    if word not in SUITES:
        raise UnknownWord("suite", word, sorted(SUITES))
    return SUITES[word]

"""Suites: what suites.toml declares as plans; its lists of contenders, controllers and start sets."""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.base.errors import UnknownWord

ENGINES = ("ideal-rk4", "ideal-held", "native", "reference")

LONG, SHORT = 20.0, 10.0
"""Horizons [s]. SHORT is 17 settling times of a small error. LONG is for starts near 180°: rounding (1e-16)
grows there by a decade every 0.56 s, so that what has not left after 10 s of it never will."""

ON_ARM = 5.0
"""Horizon on arms [s]: eight settling times of a small error. What has not settled by then is called timed-out."""

HORIZON = {"half-turn": LONG, "poles": LONG, "wraps": LONG}
"""Horizons of start sets of the free body that are not SHORT [s]."""

NOMINAL, IDEAL_MOTORS = "nominal", "ideal-motors"
"""Variations of an arm: as it is, and as the paper assumes. The free body has the first alone."""
SLOW = (25.0, 1.0)
"""kp [1/s^2] and damping ratio: half the natural frequency of the paper's gains."""

AT_VELOCITIES = ("clear", "uniform")
BY_EVERY_INVERSE = "rotation-vector"
"""The velocity law that is resolved by every inverse: the logarithm, which velocity interfaces take."""
WITHOUT_FACTOR = "quaternion-shortest"
"""The law that is also run at half of K: the quaternion's vector part as it is, without the factor 2."""

ALL = "all"
"""The word of suites.toml for everything there is; in a section it is None."""

DECLARED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
LISTS: dict[str, tuple[str, ...]] = {name: tuple(words) for name, words in DECLARED.pop("lists").items()}
LAWS, BEST, LATER, BOUNDED, AT_INVERSES = (
    LISTS[name] for name in ("LAWS", "BEST", "LATER", "BOUNDED", "AT_INVERSES")
)
BY_WORD_ALONE = (*LATER, *BOUNDED, *LISTS["BY_WORD_ALONE"])
STREAMED = ("rotation-matrix", *BEST)
"""What follows goals that arrive as a stream: the paper's first law, and the best of later ones."""


@dataclass(frozen=True)
class Suite:
    """A named plan: how much of each experiment is run.

    Attributes:
        name: Word on the command line.
        title: What it is for.
        sections: What it says to each experiment, by the experiment's name (suites.toml explains the keys). The
            experiment's file reads its own section.
    """

    name: str
    title: str
    sections: Mapping[str, Mapping[str, Any]]


def expand(declared: Any) -> Any:
    """Return a value of suites.toml with each list in place of its name, and None in place of ALL."""
    if declared == ALL:
        return None
    if isinstance(declared, dict):
        return {name: expand(value) for name, value in declared.items()}
    if isinstance(declared, list):
        return tuple(_expand_list(declared))
    return declared


def _expand_list(declared: list) -> Iterable:
    for value in declared:
        if isinstance(value, str) and value in LISTS:
            yield from LISTS[value]
        else:
            yield expand(value)


def read_suite(name: str, declared: dict[str, Any]) -> Suite:
    """Return a suite from its table in suites.toml."""
    sections = {key: expand(value) for key, value in declared.items() if key != "title"}
    return Suite(name, declared["title"], sections)


SUITES = {name: read_suite(name, declared) for name, declared in DECLARED.items()}


def suite(word: str) -> Suite:
    """Return the suite of that name."""
    if word not in SUITES:
        raise UnknownWord("suite", word, sorted(SUITES))
    return SUITES[word]

"""Which laws are run on arms by which Jacobian and inverse, and what goes together on so many joints.

A combination is written `law@jacobian+inverse`; the inverse "standard" is the first of STANDARD that fits.
"""

from collections.abc import Iterable

from bench.law.contender import Contender, refusal
from bench.law.contenders.registry import baselines_of_arms, contenders, inverse, jacobian

STANDARD = ("solve", "pseudo-inverse", "truncated-svd")
"""What inverts a Jacobian if nothing is said: exact where it is square, of least norm where it is not, and by singular
values where its rank is less than its rows and columns (a quaternion on seven joints)."""

SHOWN = 3
"""Reasons of a refusal that are printed."""


def on(words: tuple[str, ...], laws: dict[str, Contender], joints: int) -> list[Contender]:
    """Return the contenders of the words (of a baseline its name) that fit on so many joints; other words go."""
    found = (_of_word(word, laws, joints) for word in words)
    return list(dict.fromkeys(one for one in found if one is not None))


def baselines(joints: int) -> list[Contender]:
    """Every baseline on so many joints, by the geometric Jacobian and the standard inverse unless it brings its own."""
    found = baselines_of_arms()
    words = (name if one.jacobian else f"{name}@geometric+standard" for name, one in found.items())
    return on(tuple(words), found, joints)


def _of_word(word: str, laws: dict[str, Contender], joints: int) -> Contender | None:
    """Return the contender of a word `law@jacobian+inverse` on so many joints; None if nothing fits."""
    law, _, way = word.partition("@")
    jacobian_word, _, inverse_word = way.partition("+")
    if law not in laws:
        return None
    if not way:
        return laws[law]
    by = laws[law]._replace(jacobian=jacobian(jacobian_word))
    inverses = STANDARD if inverse_word == "standard" else (inverse_word,)
    fitting = (by._replace(inverse=inverse(word)) for word in inverses)
    return next((one for one in fitting if not refusal(one, joints)), None)


def chosen(
    words: tuple[str, ...],
    laws: dict[str, Contender],
    joints: int,
    jacobians: tuple[str, ...] = (),
    inverses: tuple[str, ...] = (),
    by_word_alone: tuple[str, ...] = (),
) -> list[Contender]:
    """Return the contenders of the words on so many joints; of named Jacobians and inverses every one that fits.

    A law that no word names is taken by the geometric Jacobian and the standard inverse, unless it is one of
    `by_word_alone` and others are there. No words at all: everything that fits.
    """
    if jacobians or inverses or not words:
        wanted = _crossed(laws.values(), jacobians, inverses)
        return [one for one in wanted if not refusal(one, joints)]
    wordless = [name for name in laws if not any(word.startswith(f"{name}@") for word in words)]
    if len(wordless) < len(laws):
        wordless = [name for name in wordless if laws[name].regulator.name not in by_word_alone]
    return on((*words, *(f"{name}@geometric+standard" for name in wordless)), laws, joints)


def refusals(
    laws: Iterable[Contender], joints: int, jacobians: tuple[str, ...] = (), inverses: tuple[str, ...] = ()
) -> list[str]:
    """Each reason why some of them cannot control an arm of so many joints, with the first that has it."""
    first: dict[str, str] = {}
    for one in _crossed(laws, jacobians, inverses):
        first.setdefault(refusal(one, joints), one.name)
    return [f"'{name}' on {joints} joints: {reason}" for reason, name in first.items() if reason]


def shown(reasons: list[str]) -> str:
    """Return the first of many reasons, on one line."""
    return "; ".join(reasons[:SHOWN]) + (f"; and {len(reasons) - SHOWN} more" if len(reasons) > SHOWN else "")


def _crossed(laws: Iterable[Contender], jacobians: tuple[str, ...], inverses: tuple[str, ...]) -> list[Contender]:
    """Each law by each Jacobian and inverse that is named, or by every one."""
    return [
        law._replace(jacobian=jacobian(by), inverse=inverse(through))
        for law in laws
        for by in dict.fromkeys(jacobians or contenders("jacobians"))
        for through in dict.fromkeys(inverses or contenders("inverses"))
    ]

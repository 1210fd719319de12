"""Say what was found in a log of actions, how sure it is, and what is wrong with it."""

from typing import Any, NamedTuple

import numpy as np

from bench.audit.actions.conventions import RELATIONS, REPRESENTATIONS, log
from bench.audit.actions.fit import TOLERANCE, Convention
from bench.audit.actions.search import DEGREE, ENOUGH, FEWEST, Found, is_reached, search
from bench.base.errors import BadNumber, UnknownWord

UNITS = {"radians": 1.0, "degrees": DEGREE}
FAMILIES = {"quaternion": "quaternion-order", "euler": "euler-order", "6d": "rows-columns", "matrix": "rows-columns"}
ROUNDING = 1e-3
"""Deviation of a squared length from that of a unit quaternion, or of two or three columns, that is no rounding."""


def audit_actions(R: Any, action: np.ndarray, R_next: Any = None, episode: Any = None, *, expect: str = "") -> "Report":
    """Return what the rotation part of actions means.

    Args:
        R: orientations (n x 3 x 3), or a dict of them by the name of a reading, of which the right one is found.
        action: three, four, six or nine numbers (n x m).
        R_next: orientations after the action, as R; the next ones of the same episode if left out.
        episode: number of the episode of every row; one if left out.
        expect: words that have to be found: a representation, a relation, radians, degrees, scale=0.5, lag=1, target.

    Errors:
        BadNumber: no representation has m numbers, or the counts of rows differ. UnknownWord: a word of `expect`.
    """
    action, words = np.asarray(action, float), tuple(expect.replace(",", " ").split())
    now, later = (one if isinstance(one, dict) or one is None else {"matrix": np.asarray(one)} for one in (R, R_next))
    episode = np.zeros(len(action)) if episode is None else np.asarray(episode)
    if action.ndim != 2 or action.shape[1] not in REPRESENTATIONS:
        raise BadNumber(f"actions of shape {action.shape} are no rotations; give 3, 4, 6 or 9 columns, as action[3:6]")
    if {*map(len, (*now.values(), *(later or {}).values(), episode))} != {len(action)}:
        raise BadNumber(f"{len(action)} actions have not as many poses and episodes; give one of each in every row")
    check(words, action.shape[1])
    is_whole = np.isfinite(action).all(axis=1)
    t = np.flatnonzero(is_whole if later else is_whole & np.append(episode[:-1] == episode[1:], False))
    poses = {one: (R[t], later[one][t] if later else R[t + 1]) for one, R in now.items()}
    return Report(search(poses, action[t], episode[t]), words, action[t])


def check(words: tuple[str, ...], width: int) -> None:
    """Refuse stated words that are in no list, and numbers that are none."""
    known = [*REPRESENTATIONS[width], *RELATIONS, "delta", "target", *UNITS, "scale=NUMBER", "lag=NUMBER"]
    for word in words:
        key, _, number = word.partition("=")
        if word not in known and f"{key}=NUMBER" not in known:
            raise UnknownWord("expectation", word, known)
        if number and not number.lstrip("-").replace(".", "", 1).isdigit():
            raise BadNumber(f"{word} has no number; write it as {key}=1")


def list_words(one: Convention) -> set[str]:
    """Return the words that are true of a convention."""
    words = {one.representation, one.relation, f"lag={one.lag}", "target" if one.follows else ""}
    if one.gain < 0.0:  # the inverse of xyz is XYZ of the negated angles
        words |= {one.representation.swapcase().replace("EULER", "euler")}
    return words | ({"delta"} if one.relation in ("base", "body") else set())


def describe(one: Convention) -> str:
    """Return a convention in words."""
    to, lag = ", from the last target" * (one.follows > 0.0), f", action t moves pose t{one.lag:+d}" * (one.lag != 0)
    return f"{one.representation}, {one.relation}: {RELATIONS[one.relation]}{to}{lag}"


class Report(NamedTuple):
    """What was found, of what was stated; action: the actions that were judged."""

    found: Found
    stated: tuple[str, ...]
    action: np.ndarray

    @property
    def code(self) -> int:
        """Exit code: 0 found, 1 found with a fault or not as stated, 2 not found."""
        return 2 if not self.found.best else 1 if self.faults() else 0

    def compare(self, one: Convention, per_unit: float) -> dict[str, str]:
        """Return the faults of what was stated and is true of nothing that explains the log."""
        faults, family = {}, one.representation.partition("-")[0]
        true = set().union(*map(list_words, (one, *self.found.rivals)))
        for word in self.stated:
            if word in UNITS or word.startswith("scale"):
                part = per_unit / (UNITS.get(word) or float(word.partition("=")[2]))
                fits = [is_reached(part * times) for times in (1.0, DEGREE, 1.0 / DEGREE)]
                if not fits[0]:
                    faults["degrees" if any(fits) else "scale"] = f"stated {word}, found {per_unit:.4g} rad for 1"
            elif word not in true:
                name = (
                    "side" if {word, one.relation} <= {"base", "body"} else "lag" if word[:3] == "lag" else "relation"
                )
                if word in REPRESENTATIONS[self.action.shape[1]]:
                    name = FAMILIES.get(family, "representation") if word.startswith(family) else "representation"
                faults[name] = f"stated {word}, found {describe(one)}"
        return faults

    def faults(self) -> dict[str, str]:
        """Return what is wrong, by name: differences from what was stated, and what no statement makes right."""
        if not self.found.best:
            return {}
        one, mixed, width = self.found.best.convention, self.found.mixed, self.action.shape[1]
        per_unit, turn = abs(one.gain * one.unit), log(one.turn[None])[0]
        faults = self.compare(one, per_unit)
        if one.gain < 0.0 or one.is_inverse:
            faults["inverse"] = "the robot turns the other way; the action is transposed, negated, or from the goal"
        if one.offset:
            angle = np.degrees(np.linalg.norm(turn))
            faults["offset"] = (
                f"{one.offset} turned by {angle:.1f}° about {(turn / np.linalg.norm(turn)).round(2).tolist()}"
            )
        if one.clip == "component":
            faults["clip"] = f"the robot clips each number at {one.bound:.3g}, which turns the axis; scale the vector"
        if one.lag and f"lag={one.lag}" not in self.stated:
            faults["lag"] = f"action t moves pose t{one.lag:+d}"
        if one.relation == "difference" and "difference" not in self.stated:
            faults["difference"] = "differences of coordinates, which compose to no rotation; use log(R' R^T)"
        if mixed:
            where = f"{len(mixed.at)} rows from {mixed.at.min()} to {mixed.at.max()}"
            faults["mixed"] = f"{where} are explained by {describe(mixed.convention)}"
        if width > 3 and per_unit > 1.2:
            faults["amplified"] = f"the pose turns {per_unit:.2f} times as far as the action says"
        length = (self.action**2).sum(axis=1) / {3: 1.0, 4: 1.0, 6: 2.0, 9: 3.0}[width]
        if width > 3 and (share := np.mean(np.abs(length - 1.0) > ROUNDING)) > 0.01:
            faults["not-unit"] = (
                f"{share:.0%} of the actions have not the length of a rotation; is each number clipped?"
            )
        return faults

    def text(self) -> str:
        """Return the report for people."""
        found, best = self.found, self.found.best
        if not best:
            need = f"none explains {ENOUGH:.0%} of {found.rows} rows that move (at least {FEWEST} have to)"
            return f"no convention explains this log: {need} and twice as many as with shuffled actions\n"
        one, residual, faults = best.convention, float(np.median(best.residual)), self.faults()
        per = abs(one.gain * one.unit)
        scales = [
            f"{per / unit:.0%} of it, if it is in {word}" for word, unit in UNITS.items() if is_reached(per / unit)
        ]
        size = f"1 in the action turns the pose by {per:.4g} rad ({'; '.join((*scales, 'scale times gain'))})"
        target = f", and each step goes {one.follows:.0%} of the way to the target" * (one.follows > 0.0)
        clip = f"; clipped by {one.clip} at {one.bound:.3g}" * bool(one.clip)
        lines = [
            f"found: {describe(one)} (reading of the poses: {one.pose})",
            (size if self.action.shape[1] == 3 else f"a step reaches {per:.1%} of the action") + target + clip,
            f"explains {best.share:.1%} of {found.rows} rows that move, to {TOLERANCE:.0%} of the motion; with shuffled "
            f"actions {found.shuffled:.1%}; median residual {residual:.2g} rad",
            *(f"explains it as well: {describe(each)}; {self.distinguish(each, residual)}" for each in found.rivals),
            *(
                f"next: {describe(each)}; worse in {sure:.1%} of bootstrap draws"
                for each, sure in [x for x in zip(found.others, found.sure, strict=True) if x[0] not in found.rivals][
                    :1
                ]
            ),
            *(f"FAULT {name}: {text}" for name, text in faults.items()),
        ]
        return "\n".join(lines) + "\n"

    def distinguish(self, other: Convention, residual: float) -> str:
        """Return the data that would distinguish another convention from the best."""
        one, angle = self.found.best.convention, np.degrees(np.sqrt(2.0 * residual))
        if (other.lag, other.pose) != (one.lag, one.pose):
            return "actions that change more from row to row would distinguish them"
        if other.relation != one.relation:
            return (
                f"orientations further apart than now, {np.degrees(self.found.spread):.0f}° rms, would distinguish them"
            )
        return f"single actions of more than {angle:.0f}° about an oblique axis would distinguish them"

    def as_dict(self) -> dict[str, Any]:
        """Return all of it for machines."""
        found, best = self.found, self.found.best
        known = {"rows": found.rows, "shuffled": found.shuffled, "exit_code": self.code, "faults": self.faults()}
        if not best:
            return {"verdict": "no convention explains this log", **known}
        plain = {**best.convention._asdict(), "turn": best.convention.turn.tolist()}
        plain["bound"] = best.convention.bound if best.convention.clip else None
        others = [
            {"convention": describe(one), "worse_in": sure} for one, sure in zip(found.others, found.sure, strict=True)
        ]
        return {"verdict": "found", **known, "convention": plain, "share": best.share, "others": others}

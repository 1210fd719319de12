"""Say what was found in a log of actions, how sure it is, and what is wrong with it."""

from typing import Any, NamedTuple

import numpy as np

from bench.audit.actions.conventions import RELATIONS, REPRESENTATIONS
from bench.audit.actions.fit import TOLERANCE, ActionConvention
from bench.audit.actions.search import DEGREE, ENOUGH, FEWEST, LogExplanation, is_reached, search
from bench.audit.rotations import log
from bench.base.errors import BadNumber, UnknownWord

UNITS = {"radians": 1.0, "degrees": DEGREE}
FAMILIES = {"quaternion": "quaternion-order", "euler": "euler-order", "6d": "rows-columns", "matrix": "rows-columns"}
ROUNDING = 1e-3
"""Deviation of a squared length from that of a unit quaternion, or of two or three columns, that is no rounding."""


def audit_actions(
    R: Any, action: np.ndarray, R_next: Any = None, episode: Any = None, *, expect: str = ""
) -> "ActionReport":
    """Return what the rotation part of actions means.

    Args:
        R: orientations (n x 3 x 3), or a dict of them by the name of a reading, of which the right one is found.
        action: three, four, six or nine numbers (n x m).
        R_next: orientations after the action, as R; the next ones of the same episode if left out.
        episode: number of the episode of every row; one if left out.
        expect: words that have to be found: a representation, a relation, radians, degrees, scale=0.5, lag=1, target.
    """
    action, words = np.asarray(action, float), tuple(expect.replace(",", " ").split())
    now, later = (one if isinstance(one, dict) else {"matrix": np.asarray(one)} for one in (R, R_next))
    later = {} if R_next is None else later
    episode = np.zeros(len(action)) if episode is None else np.asarray(episode)
    if action.ndim != 2 or action.shape[1] not in REPRESENTATIONS:
        raise BadNumber(f"actions of shape {action.shape} are no rotations; give 3, 4, 6 or 9 columns, as action[3:6]")
    if {*map(len, (*now.values(), *later.values(), episode))} != {len(action)}:
        raise BadNumber(f"{len(action)} actions have not as many poses and episodes; give one of each in every row")
    known = [*REPRESENTATIONS[action.shape[1]], *RELATIONS, "delta", "target", *UNITS, "scale=NUMBER", "lag=NUMBER"]
    for word in words:
        key, _, number = word.partition("=")
        if word not in known and not (f"{key}=NUMBER" in known and number.lstrip("-").replace(".", "", 1).isdigit()):
            raise UnknownWord("expectation", word, known)
    is_whole = np.isfinite(action).all(axis=1) & np.all([np.isfinite(R).all(axis=(1, 2)) for R in now.values()], axis=0)
    is_followed = np.append((episode[:-1] == episode[1:]) & is_whole[1:], False)
    t = np.flatnonzero(is_whole if later else is_whole & is_followed)
    poses = {one: (R[t], later[one][t] if later else R[t + 1]) for one, R in now.items()}
    return ActionReport(search(poses, action[t], episode[t]), words, action[t], t)


def list_words(one: ActionConvention) -> set[str]:
    """Return the words that are true of a convention."""
    words = {one.representation, one.relation, f"lag={one.lag}", "target" if one.follows else "pose"}
    words |= {"delta"} if one.relation in ("base", "body") else set()
    is_negated = one.gain < 0.0 and one.representation.startswith("euler")  # the inverse of xyz is XYZ of -a
    return words | {f"euler-{one.representation[6:].swapcase()}"} if is_negated else words


def describe(one: ActionConvention) -> str:
    """Return a convention in words."""
    to, lag = " from the last target" * (one.follows > 0.0), f", action t moves pose t{one.lag:+d}" * (one.lag != 0)
    return f"{one.representation}, {one.relation} ({RELATIONS[one.relation]}){to}{lag}"


class ActionReport(NamedTuple):
    """What was found, of what was stated; the actions that were judged, and their rows in the log."""

    found: LogExplanation
    stated: tuple[str, ...]
    action: np.ndarray
    row: np.ndarray

    @property
    def code(self) -> int:
        """Exit code: 0 found, 1 found with a fault or not as stated, 2 not found."""
        return 2 if not self.found.best else 1 if self.faults() else 0

    def faults(self) -> dict[str, str]:
        """Return what is wrong, by name: differences from what was stated, and what no statement makes right."""
        if not self.found.best:
            return {}
        one, mixed, width = self.found.best.convention, self.found.mixed, self.action.shape[1]
        faults: dict[str, str] = {}
        size, turn = abs(one.gain * one.unit), log(one.turn[None])[0]
        true = set().union(*map(list_words, (one, *self.found.rivals)))
        family = one.representation.partition("-")[0]
        for word in self.stated:
            if word in UNITS or word.startswith("scale"):
                part = size / (UNITS.get(word) or float(word.partition("=")[2]) or np.inf)
                name = "degrees" if is_reached(part / DEGREE) or is_reached(part * DEGREE) else "scale"
                faults |= {} if is_reached(part) else {name: f"stated {word}, found {size:.4g} rad for 1 in the action"}
            elif word not in true:
                name = "side" if {word, one.relation} <= {"base", "body"} else "relation"
                name = FAMILIES.get(family, "representation") if word.startswith(family) else name
                name = "representation" if name == "relation" and word in REPRESENTATIONS[width] else name
                faults["lag" if word.startswith("lag") else name] = f"stated {word}, found {describe(one)}"
        if one.is_backward:
            faults["inverse"] = "the robot turns the other way; the action is transposed, negated, or from the goal"
        if one.offset:
            angle, axis = np.degrees(np.linalg.norm(turn)), (turn / np.linalg.norm(turn)).round(2).tolist()
            faults["offset"] = f"the {one.offset} is turned by {angle:.1f}° about {axis}"
        if one.clip == "component":
            faults["clip"] = f"the robot clips each number at {one.bound:.3g}, which turns the axis; scale the vector"
        if one.lag and f"lag={one.lag}" not in self.stated:
            faults["lag"] = f"action t moves pose t{one.lag:+d}"
        if one.relation == "difference" and "difference" not in self.stated:
            faults["difference"] = "differences of coordinates, which compose to no rotation; use log(R' R^T)"
        if mixed:
            where = f"{len(mixed.at)} rows from {self.row[mixed.at.min()]} to {self.row[mixed.at.max()]}"
            faults["mixed"] = f"{where} are explained by {describe(mixed.convention)}"
        if width > 3 and not is_reached(size):
            faults["amplified" if size > 1.0 else "slow"] = f"the pose turns {size:.2f} times as far as the action says"
        length = (self.action**2).sum(axis=1) / {3: 1.0, 4: 1.0, 6: 2.0, 9: 3.0}[width]
        if width > 3 and (share := np.mean(np.abs(length - 1.0) > ROUNDING)) > 0.01:
            faults["not-unit"] = f"{share:.0%} of the actions are not as long as a rotation; is each number clipped?"
        return faults

    def as_dict(self) -> dict[str, Any]:
        """Return all of it for machines."""
        found, best = self.found, self.found.best
        one = best.convention._asdict() | {"turn": best.convention.turn.tolist()} if best else None
        if one and not one["clip"]:
            one["bound"] = None
        shares = {"rows": found.rows, "share": best.share if best else 0.0, "shuffled": found.shuffled}
        second = {"convention": describe(found.second), "worse_in": found.sure} if found.second else None
        others = {"explains_as_well": [describe(each) for each in found.rivals], "second": second}
        return {"exit_code": self.code, "convention": one, **shares, **others, "faults": self.faults()}

    def text(self) -> str:
        """Return the report for people."""
        found, best = self.found, self.found.best
        if not best:
            need = f"none explains {ENOUGH:.0%} of {found.rows} rows that move (at least {FEWEST} have to)"
            return f"no convention explains this log: {need}, and twice as many as with shuffled actions\n"
        one, residual = best.convention, float(np.median(best.residual))
        size = abs(one.gain * one.unit)
        guess = [f"{size / unit:.0%} of it in {word}" for word, unit in UNITS.items() if is_reached(size / unit)]
        is_scaled = self.action.shape[1] == 3 and one.relation != "absolute"
        scale = f"1 in the action turns the pose by {size:.4g} rad ({', '.join((*guess, 'scale times gain'))})"
        data = f"orientations further apart than {np.degrees(found.spread):.0f}° rms, and single actions of more than "
        data += f"{np.degrees(np.sqrt(2.0 * residual)):.0f}° about oblique axes, would distinguish them"
        lines = [
            f"found: {describe(one)}; reading of the poses: {one.pose}",
            scale if is_scaled else f"a step reaches {abs(one.gain):.1%} of the action",
            *[f"a step goes {one.follows:.0%} of the way to the target"][: bool(one.follows)],
            *[f"the robot clips by {one.clip} at {one.bound:.3g}"][: bool(one.clip)],
            f"explains {best.share:.1%} of {found.rows} rows that move, to {TOLERANCE:.0%} of their motion; with the "
            f"actions shuffled {found.shuffled:.1%}; median residual {residual:.2g} rad",
            *(f"explains it as well: {describe(each)}" for each in found.rivals),
            *[data][: len(found.rivals)],
            *[f"next: {describe(found.second or one)}, worse in {found.sure:.1%} of draws"][: bool(found.second)],
            *(f"FAULT {name}: {text}" for name, text in self.faults().items()),
        ]
        return "\n".join(lines) + "\n"

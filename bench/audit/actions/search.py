"""Find the convention that explains a log best, how sure that is, and what else explains it."""

import itertools
from typing import NamedTuple

import numpy as np

from bench.audit.actions.conventions import COORDINATES, REPRESENTATIONS, log
from bench.audit.actions.fit import Convention, Rows, align, fit, nearest

LAGS, DEGREE = range(-1, 6), np.pi / 180.0
FEWEST, SAMPLE, TOP = 50, 300, 10
"""Rows that have to move; rows on which all conventions are tried; conventions that are tried on all rows."""
ENOUGH, SURE, BETTER = 0.6, 0.99, 0.8
"""Part of the rows to explain; of the bootstrap draws to win; of the loss that a further parameter may leave."""
SEED, DRAWS, BLOCK = 3, 400, 25


def is_reached(part: float) -> bool:
    """Tell whether a step may reach this part of an action; beyond them the scale is another one."""
    return 0.2 <= part <= 1.2


class Fitted(NamedTuple):
    """A fitted convention, the rows (n) of its poses, their residual [rad] and loss: residual/tolerance, at most 1."""

    convention: Convention
    at: np.ndarray
    residual: np.ndarray
    loss: np.ndarray

    @property
    def cost(self) -> float:
        """Mean loss, raised for every parameter of the convention beyond its gain."""
        return float(self.loss.mean()) / BETTER**self.convention.extras

    @property
    def share(self) -> float:
        """Share of rows that it explains."""
        return float(np.mean(self.loss < 1.0))


def fit_each(rows: dict, several: list[Convention]) -> list[Fitted]:
    """Fit conventions to the rows of their reading and lag, and return them with the best first."""
    found = []
    for one in several:
        here = rows[one.pose, one.lag]
        one, residual = fit(here, one)
        found.append(Fitted(one, here.at, residual, np.minimum(residual / here.tolerance, 1.0)))
    return sorted(found, key=lambda each: each.cost)


def screen(rows: Rows, pose: str, lag: int, is_turned: bool) -> list[tuple[float, Convention]]:
    """Return all conventions without clip and target, or all with a constant rotation, with the loss of a quick fit."""
    R, R_next, a, found = rows.R, rows.R_next, rows.action, []
    width, back = a.shape[1], rows.R.swapaxes(1, 2)
    names = list(REPRESENTATIONS[width])
    moved = {"base": log(R_next @ back), "body": log(back @ R_next)}

    def rate(v: np.ndarray, u: np.ndarray, made: list[Convention]) -> None:
        k = np.quantile((v * u).sum(axis=2) / np.maximum((u * u).sum(axis=2), 1e-300), (0.25, 0.5, 0.75), axis=1)
        missed = np.linalg.norm(v - k[:, :, None, None] * u, axis=3) / rows.tolerance
        loss = np.minimum(missed, 1.0).mean(axis=2)
        best = loss.argmin(axis=0)
        found.extend(
            (float(loss[i, m]), one._replace(gain=float(k[i, m])))
            for m, (i, one) in enumerate(zip(best, made, strict=True))
        )

    def decode(unit: float) -> np.ndarray:
        return np.array([one(unit * a) for one in REPRESENTATIONS[width].values()])

    first = Convention(pose, "rotation-vector", "base", lag)
    size = max(abs(fit(rows, first._replace(relation=one))[0].gain) for one in moved) or 1.0 if width == 3 else 1.0
    u = log(decode(size).reshape(-1, 3, 3)).reshape(len(names), -1, 3)  # Euler angles of the size of the motion
    for relation, v in moved.items():
        made = [Convention(pose, name, relation, lag, size, offset="frame" * is_turned) for name in names]
        C = np.array([nearest(M, is_signed=True) for M in np.einsum("nj,mnk->mjk", v, u)]) if is_turned else np.eye(3)
        rate(v, u @ C.swapaxes(-1, -2), made)
    for unit in (1.0, DEGREE)[: 2 if width == 3 else 1]:
        A = decode(unit)
        for is_inverse, offset in ((False, "tool"), (False, "base")) if is_turned else ((False, ""), (True, "")):
            B = A.swapaxes(2, 3) if is_inverse else A
            if offset == "tool":
                B = B @ np.array([nearest(M) for M in (B.swapaxes(2, 3) @ R_next).mean(axis=1)])[:, None]
            elif offset:
                B = np.array([nearest(M) for M in (R_next @ B.swapaxes(2, 3)).mean(axis=1)])[:, None] @ B
            made = [Convention(pose, name, "absolute", lag, unit, is_inverse, offset) for name in names]
            rate(moved["body"], log((back @ B).reshape(-1, 3, 3)).reshape(len(names), -1, 3), made)
    for name in COORDINATES if width == 3 and not is_turned else ():
        c = COORDINATES[name]
        v = np.remainder(c(R_next) - c(R) + np.pi, 2.0 * np.pi) - np.pi
        rate(v, a[None], [Convention(pose, name, "difference", lag)])
    return found


def scale(rows: dict, one: Convention) -> Convention:
    """Return a delta of Euler angles with the unit that explains the rows best."""
    if not one.representation.startswith("euler") or one.relation not in ("base", "body"):
        return one
    units = (1.0, DEGREE, *(abs(one.gain * one.unit) / np.linspace(0.3, 1.0, 8)))
    tried = [each.convention for each in fit_each(rows, [one._replace(unit=float(unit)) for unit in units])]
    return next((each for each in tried if is_reached(abs(each.gain))), one)


def extend(rows: dict, one: Convention) -> Convention:
    """Return it with a target or clip if that is much better."""
    action, others = rows[one.pose, one.lag].action, []
    if one.relation in ("base", "body"):
        others = [one._replace(follows=float(k)) for k in np.linspace(0.1, 0.9, 17)]
    for clip, size in (("component", np.abs(action)), ("norm", np.linalg.norm(action, axis=1))):
        bounds = (*np.quantile(size, np.linspace(0.2, 0.98, 14)), *(size.max() * np.linspace(0.1, 0.9, 9)))
        others += [one._replace(clip=clip, bound=float(b)) for b in bounds if action.shape[1] in (3, 6)]
    return fit_each(rows, [one, *others])[0].convention


def compare(best: Fitted, other: Fitted) -> float:
    """Return the share of block bootstrap draws in which the loss of the first is smaller by 1 % or more."""
    _, i, j = np.intersect1d(best.at, other.at, return_indices=True)
    sums = np.array([one.sum() for one in np.array_split(other.loss[j] - 1.01 * best.loss[i], len(i) // BLOCK + 2)])
    draws = np.random.default_rng(SEED).integers(0, len(sums), size=(DRAWS, len(sums)))
    return float(np.mean(sums[draws].sum(axis=1) > 0.0))


class Found(NamedTuple):
    """What explains a log, of so many rows that move: best, or None.

    shuffled: share of rows that best explains with the actions in another order; rivals: what explains the log as well;
    second: the best of what does not, and sure: share of bootstrap draws in which it is worse; mixed: what explains the
    rows that best does not; spread: rms angle of the orientations from their mean [rad].
    """

    rows: int
    best: Fitted | None = None
    shuffled: float = 0.0
    rivals: tuple[Convention, ...] = ()
    second: Convention | None = None
    sure: float = 1.0
    mixed: Fitted | None = None
    spread: float = 0.0


def search(poses: dict[str, tuple[np.ndarray, np.ndarray]], action: np.ndarray, episode: np.ndarray) -> Found:
    """Find what explains a log, over all readings of its poses (by name), lags, representations and relations."""
    logs = {(pose, lag): align(*both, action, episode, lag) for pose, both in poses.items() for lag in LAGS}
    logs = {key: rows for key, rows in logs.items() if len(rows.at) >= FEWEST}
    if not logs:
        return Found(0)
    few = {key: rows.chosen(slice(None, None, -(-len(rows.at) // SAMPLE))) for key, rows in logs.items()}
    quick = [one for key, rows in few.items() for one in screen(rows, *key, is_turned=False)]
    if min(loss for loss, _ in quick) > ENOUGH:
        quick += [one for key, rows in few.items() if abs(key[1]) < 2 for one in screen(rows, *key, is_turned=True)]
    is_named = [action.shape[1] < 6 or one.gain > 0.0 and not one.is_inverse for _, one in quick]  # rows and columns
    plain = [
        one
        for _, one in sorted(itertools.compress(quick, is_named), key=lambda each: each[0] / BETTER ** each[1].extras)
    ]
    top = [each.convention for each in fit_each(few, [scale(few, one) for one in plain[:TOP]])]
    best, *others = fit_each(logs, [*(extend(few, one) for one in top[:4]), *top[4:]])
    one = best.convention
    places = {"absolute": ("tool", "base"), "difference": ()}.get(one.relation, ("frame",))[: 2 * (not one.offset)]
    rows, best = logs[one.pose, one.lag], fit_each(logs, [one, *(one._replace(offset=place) for place in places)])[0]
    left = {key: each.chosen(np.isin(each.at, best.at[best.loss >= 1.0])) for key, each in logs.items()}
    rest = [each for each in plain[: 4 * TOP] if each.lag == one.lag and not each.offset]
    is_enough = len(left[one.pose, one.lag].at) > max(FEWEST // 2, 0.05 * len(rows.at))
    mixed = next((each for each in fit_each(left, rest if is_enough else []) if each.share >= ENOUGH), None)
    order = np.random.default_rng(SEED).permutation(len(rows.at))
    shuffled = fit_each({(one.pose, one.lag): rows._replace(action=rows.action[order])}, [best.convention])[0].share
    if (
        best.share + (mixed.share * len(mixed.at) / len(rows.at) if mixed else 0.0) < ENOUGH
        or shuffled > best.share / 2
    ):
        return Found(len(rows.at), shuffled=shuffled)
    others = [each for each in others if each.convention.extras <= best.convention.extras]
    others = [each for each in others if not mixed or each.convention[:3] != mixed.convention[:3]]
    spread = np.linalg.norm(log(nearest(rows.R.mean(axis=0)).T @ rows.R), axis=1)
    sure = {id(each): compare(best, each) for each in others}
    equal = [best, *(each for each in others if sure[id(each)] < SURE)]
    best = min(equal, key=lambda each: each.convention.suspicion)
    beaten = [(each.convention, sure[id(each)]) for each in others if sure[id(each)] >= SURE][:1]
    rivals = tuple(each.convention for each in equal if each is not best)
    return Found(
        len(rows.at), best, shuffled, rivals, *(beaten or [(None, 1.0)])[0], mixed, float(np.sqrt(np.mean(spread**2)))
    )

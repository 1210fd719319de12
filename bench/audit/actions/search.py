"""Find the convention that explains a log best, how sure that is, and what else explains it."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from bench.audit.actions.conventions import COORDINATES, REPRESENTATIONS
from bench.audit.actions.fit import ActionConvention, LogRows, align, fit, nearest
from bench.audit.rotations import log

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

    convention: ActionConvention
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


def fit_each(rows: dict, several: list[ActionConvention], rounds: int = 5) -> list[Fitted]:
    """Fit conventions to the rows of their reading and lag, and return them with the best first."""
    found = []
    for one in several:
        here = rows[one.pose, one.lag]
        one, residual = fit(here, one, rounds)
        found.append(Fitted(one, here.at, residual, np.minimum(residual / here.tolerance, 1.0)))
    return sorted(found, key=lambda each: each.cost)


def list_plain(rows: LogRows, pose: str, lag: int) -> Iterator[ActionConvention]:
    """Yield the conventions without clip, target and constant rotation."""
    width = rows.action.shape[1]
    for start in (
        ActionConvention(pose, "rotation-vector", relation, lag) for relation in ("base", "body")
    ):
        unit = abs(fit(rows, start)[0].gain) or 1.0 if width == 3 else 1.0  # Euler angles of the size of the motion
        yield from (start._replace(representation=name, unit=unit) for name in REPRESENTATIONS[width])
    for is_inverse in (False, True)[: 2 if width < 6 else 1]:  # the inverse of rows is columns
        for unit in (1.0, DEGREE)[: 2 if width == 3 else 1]:
            yield from (
                ActionConvention(pose, name, "absolute", lag, unit, is_inverse)
                for name in REPRESENTATIONS[width]
            )
    yield from (
        ActionConvention(pose, name, "difference", lag) for name in COORDINATES if width == 3
    )


def list_offset(one: ActionConvention) -> list[ActionConvention]:
    """Return a convention with a constant rotation, where it may have one."""
    places = {"absolute": ("tool", "base"), "difference": ()}.get(one.relation, ("frame",))
    return [one._replace(offset=place) for place in places if not one.offset and not one.is_inverse]


def refine(rows: dict, one: ActionConvention, is_extended: bool) -> ActionConvention:
    """Return it with the best unit of Euler angles, and with a target or clip if that is much better."""
    action, is_delta, others = rows[one.pose, one.lag].action, one.relation in ("base", "body"), []
    if is_delta and one.representation.startswith("euler"):
        units = (1.0, DEGREE, *(abs(one.gain * one.unit) / np.linspace(0.3, 1.0, 8)))
        tried = fit_each(rows, [one._replace(unit=float(unit)) for unit in units])
        one = next((each.convention for each in tried if is_reached(abs(each.convention.gain))), one)
    if is_extended and action.shape[1] in (3, 6):
        for clip, size in (("component", np.abs(action)), ("norm", np.linalg.norm(action, axis=1))):
            bounds = (*np.quantile(size, np.linspace(0.2, 0.98, 14)), *(size.max() * np.linspace(0.1, 0.9, 9)))
            others += [one._replace(clip=clip, bound=float(bound)) for bound in bounds]
    others += [one._replace(follows=float(k)) for k in np.linspace(0.1, 0.9, 17) if is_extended and is_delta]
    return fit_each(rows, [one, *others])[0].convention


def compare(best: Fitted, other: Fitted) -> float:
    """Return the share of block bootstrap draws in which the loss of the first is smaller by 1 % or more."""
    _, i, j = np.intersect1d(best.at, other.at, return_indices=True)
    sums = np.array([one.sum() for one in np.array_split(other.loss[j] - 1.01 * best.loss[i], len(i) // BLOCK + 2)])
    draws = np.random.default_rng(SEED).integers(0, len(sums), size=(DRAWS, len(sums)))
    return float(np.mean(sums[draws].sum(axis=1) > 0.0))


class LogExplanation(NamedTuple):
    """What explains a log, of so many rows that move: best, or None.

    shuffled: share of rows that best explains with the actions in another order; rivals: what explains the log as well;
    second: the best of what does not, and sure: share of bootstrap draws in which it is worse; mixed: what explains the
    rows that best does not; spread: rms angle of the orientations from their mean [rad].
    """

    rows: int
    best: Fitted | None = None
    shuffled: float = 0.0
    rivals: tuple[ActionConvention, ...] = ()
    second: ActionConvention | None = None
    sure: float = 1.0
    mixed: Fitted | None = None
    spread: float = 0.0


def search(
    poses: dict[str, tuple[np.ndarray, np.ndarray]], action: np.ndarray, episode: np.ndarray
) -> LogExplanation:
    """Find what explains a log, over all readings of its poses (by name), lags, representations and relations."""
    logs = {(pose, lag): align(*both, action, episode, lag) for pose, both in poses.items() for lag in LAGS}
    logs = {key: rows for key, rows in logs.items() if len(rows.at) >= FEWEST}
    if not logs:
        return LogExplanation(0)
    few = {key: rows.chosen(slice(None, None, -(-len(rows.at) // SAMPLE))) for key, rows in logs.items()}
    plain = fit_each(few, [one for key, rows in few.items() for one in list_plain(rows, *key)], 0)
    if plain[0].cost > ENOUGH:
        near = [turned for one in plain if abs(one.convention.lag) < 2 for turned in list_offset(one.convention)]
        plain = sorted((*plain, *fit_each(few, near, 0)), key=lambda one: one.cost)
    several = [one.convention for one in plain if action.shape[1] < 6 or one.convention.gain > 0.0]
    top = fit_each(few, [refine(few, one, is_extended=False) for one in several[:TOP]])
    best, *others = fit_each(logs, [refine(few, one.convention, k < 4) for k, one in enumerate(top)])
    one = best.convention
    rows, best = logs[one.pose, one.lag], fit_each(logs, [one, *list_offset(one)])[0]
    left = {key: each.chosen(np.isin(each.at, best.at[best.loss >= 1.0])) for key, each in logs.items()}
    least = max(FEWEST // 2, 0.05 * len(rows.at))
    rest = [c for c in several[: 4 * TOP] if c.lag == one.lag and not c.offset and len(left[c.pose, c.lag].at) > least]
    mixed = next((each for each in fit_each(left, rest) if each.share >= ENOUGH), None)
    order = np.random.default_rng(SEED).permutation(len(rows.at))
    shuffled = fit_each({(one.pose, one.lag): rows._replace(action=rows.action[order])}, [best.convention])[0].share
    explained = best.share + (mixed.share * len(mixed.at) / len(rows.at) if mixed else 0.0)
    if explained < ENOUGH or shuffled > best.share / 2:
        return LogExplanation(len(rows.at), shuffled=shuffled)
    others = [each for each in others if each.convention.extras <= best.convention.extras]
    others = [each for each in others if not mixed or each.convention[:3] != mixed.convention[:3]]
    spread = np.linalg.norm(log(nearest(rows.R.mean(axis=0)).T @ rows.R), axis=1)
    sure = {id(each): compare(best, each) for each in others}
    equal = [best, *(each for each in others if sure[id(each)] < SURE)]
    best = min(equal, key=lambda each: each.convention.suspicion)
    second, share = next(((one.convention, sure[id(one)]) for one in others if sure[id(one)] >= SURE), (None, 1.0))
    forward = [each.convention for each in equal if each.convention.is_backward <= best.convention.is_backward]
    rivals = tuple(each for each in forward if each is not best.convention)
    return LogExplanation(
        len(rows.at),
        best,
        shuffled,
        rivals,
        second,
        share,
        mixed,
        float(np.sqrt(np.mean(spread**2))),
    )

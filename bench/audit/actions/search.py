"""Find the convention that explains a log best, how sure that is, and what else explains it."""

from collections.abc import Iterator
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
    return sorted(found, key=lambda each: each.loss.mean())


def list_plain(rows: Rows, pose: str, lag: int) -> Iterator[Convention]:
    """Yield the conventions without clip, target and constant rotation."""
    width = rows.action.shape[1]
    for start in (Convention(pose, "rotation-vector", relation, lag) for relation in ("base", "body")):
        unit = abs(fit(rows, start)[0].gain) or 1.0 if width == 3 else 1.0  # Euler angles of the size of the motion
        yield from (start._replace(representation=name, unit=unit) for name in REPRESENTATIONS[width])
    for name in REPRESENTATIONS[width]:
        for is_inverse in (False, True) if width < 6 else (False,):  # the inverse of rows is columns
            units = (1.0, DEGREE) if width == 3 else (1.0,)
            yield from (Convention(pose, name, "absolute", lag, unit, is_inverse) for unit in units)
    yield from (Convention(pose, name, "difference", lag) for name in COORDINATES if width == 3)


def list_offset(several: list[Convention]) -> list[Convention]:
    """Return the same conventions with a constant rotation."""
    places = {"absolute": ("tool", "base"), "difference": (), "base": ("frame",), "body": ("frame",)}
    return [one._replace(offset=place) for one in several for place in places[one.relation]]


def refine(rows: dict, one: Convention) -> Convention:
    """Return it with the unit that explains the rows best, and with a target or clip if that is much better."""
    action, others = rows[one.pose, one.lag].action, []
    if one.relation in ("base", "body"):
        units = (1.0, DEGREE, *(abs(one.gain * one.unit) / np.linspace(0.3, 1.0, 8)))
        if one.representation.startswith("euler"):
            tried = [each.convention for each in fit_each(rows, [one._replace(unit=float(unit)) for unit in units])]
            one = next((each for each in tried if is_reached(abs(each.gain))), one)
        others = [one._replace(follows=float(k)) for k in np.linspace(0.1, 0.9, 17)]
    for clip, size in (("component", np.abs(action)), ("norm", np.linalg.norm(action, axis=1))):
        bounds = (*np.quantile(size, np.linspace(0.2, 0.98, 14)), *(size.max() * np.linspace(0.05, 0.95, 19)))
        others += [one._replace(clip=clip, bound=float(b)) for b in bounds if action.shape[1] in (3, 6)]
    return choose(rows, one, others).convention


def choose(rows: dict, one: Convention, others: list[Convention]) -> Fitted:
    """Return the fit of a convention, or the best of others with a further parameter if it is much better."""
    plain, best = fit_each(rows, [one])[0], next(iter(fit_each(rows, others)), None)
    return best if best and best.loss.mean() < BETTER * plain.loss.mean() else plain


def compare(best: Fitted, other: Fitted) -> float:
    """Return the share of block bootstrap draws in which the loss of the first is smaller by 1 % or more."""
    _, i, j = np.intersect1d(best.at, other.at, return_indices=True)
    sums = np.array([one.sum() for one in np.array_split(other.loss[j] - 1.01 * best.loss[i], len(i) // BLOCK + 2)])
    draws = np.random.default_rng(SEED).integers(0, len(sums), size=(DRAWS, len(sums)))
    return float(np.mean(sums[draws].sum(axis=1) > 0.0))


class Found(NamedTuple):
    """What explains a log, of so many rows that move: best, or None.

    others: the next ones, and sure: shares of bootstrap draws in which best is better; shuffled: share of rows that
    best explains with the actions in another order; mixed: what explains the rows that best does not; spread [rad].
    """

    rows: int
    best: Fitted | None = None
    shuffled: float = 0.0
    others: tuple[Convention, ...] = ()
    sure: tuple[float, ...] = ()
    mixed: Fitted | None = None
    spread: float = 0.0

    @property
    def rivals(self) -> list[Convention]:
        """Conventions that explain the log as well."""
        return [one for one, sure in zip(self.others, self.sure, strict=True) if sure < SURE]


def search(poses: dict[str, tuple[np.ndarray, np.ndarray]], action: np.ndarray, episode: np.ndarray) -> Found:
    """Find what explains a log, over all readings of its poses (by name), lags, representations and relations."""
    logs = {(pose, lag): align(*both, action, episode, lag) for pose, both in poses.items() for lag in LAGS}
    logs = {key: rows for key, rows in logs.items() if len(rows.at) >= FEWEST}
    if not logs:
        return Found(0)
    few = {key: rows.chosen(slice(None, None, -(-len(rows.at) // SAMPLE))) for key, rows in logs.items()}
    plain = fit_each(few, [one for key, rows in few.items() for one in list_plain(rows, *key)])
    plain = [one for one in plain if action.shape[1] < 6 or one.convention.gain > 0.0]  # as above: rows and columns
    if not plain or plain[0].share < ENOUGH:
        near = list_offset([one.convention for one in plain if abs(one.convention.lag) < 2])
        plain += fit_each({key: rows.chosen(slice(None, None, 3)) for key, rows in few.items()}, near)
        plain.sort(key=lambda one: one.loss.mean())
    best, *others = fit_each(logs, [refine(few, one.convention) for one in plain[:TOP]])
    one = best.convention
    best, rows = best if one.offset else choose(logs, one, list_offset([one])), logs[one.pose, one.lag]
    left = {key: each.chosen(np.isin(each.at, best.at[best.loss >= 1.0])) for key, each in logs.items()}
    rest = [each.convention for each in plain if each.convention.lag == one.lag and not each.convention.offset]
    is_enough = len(left[one.pose, one.lag].at) > max(FEWEST // 2, 0.05 * len(rows.at))
    mixed = next((each for each in fit_each(left, rest if is_enough else []) if each.share >= ENOUGH), None)
    order = np.random.default_rng(SEED).permutation(len(rows.at))
    shuffled = fit_each({(one.pose, one.lag): rows._replace(action=rows.action[order])}, [best.convention])[0].share
    if (
        best.share + (mixed.share * len(mixed.at) / len(rows.at) if mixed else 0.0) < ENOUGH
        or shuffled > best.share / 2
    ):
        return Found(len(rows.at), shuffled=shuffled)
    others = [each for each in others if not mixed or each.convention[:3] != mixed.convention[:3]]
    spread = np.linalg.norm(log(nearest(rows.R.mean(axis=0)).T @ rows.R), axis=1)
    sure = tuple(compare(best, each) for each in others)
    return Found(
        len(rows.at),
        best,
        shuffled,
        tuple(each.convention for each in others),
        sure,
        mixed,
        float(np.sqrt(np.mean(spread**2))),
    )

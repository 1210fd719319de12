"""Millions of random starts of a law, counted in cells of SO(3), the slowest of each ring, and those that are lost.

No suite has this experiment; `bench map` runs it. A start is settled, lost or unconverged: what becomes of it depends
on the step (`engines.convergence`).

A ring is 5 degrees of the angle to the goal. A cell is a ring in one of 128 equal parts of the sphere of axes, 8 bands
of z by 16 of the azimuth; the axis is that of the turn from the goal to the start, which is below 180 degrees.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from bench.base.on_first_use import pd
from bench.engines.episode import OUTCOME, SETTLING_TICK, START_WIDTH, STEP
from bench.experiments.columns import CONTENDER_KEY
from bench.experiments.episodes import prepare_law
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.suites import SHORT
from bench.law.contender import Contender
from bench.law.inputs import PAPERS_GAINS, Gains
from tasks.base import IDENTITY
from tasks.random_starts import BLOCK, block
from tasks.rules import RULES
from tasks.truth import angle
from tasks.verdict import OUTCOMES, SETTLED

UNIT = 8 * BLOCK
"""Starts of a unit: 131,072, some four seconds on one thread."""

START_S = 3e-5
"""CPU seconds a start."""

RINGS, BANDS, AZIMUTHS = 36, 8, 16
EDGES = np.array([math.cos(math.radians(5.0 * ring) / 2.0) for ring in range(1, RINGS)])
"""|w| of the quaternion at the rings' edges, falling."""

MOST_LOST = 1000
"""Lost and unconverged starts that are kept of a law, gains and speed."""

CELL, SLOWEST, LOST = "cell", "slowest", "lost"
PLACE = ["ring_deg", "band", "azimuth"]
STATE = [*(f"quat_{part}" for part in "wxyz"), *(f"omega0_{axis}" for axis in "xyz")]
LAW = [*CONTENDER_KEY, "kp", "kv", "engine", "seed", "least_speed", "most_speed"]


def plan_of(
    laws: list[Contender],
    starts: int,
    *,
    seed: int = 0,
    speeds: tuple[tuple[float, float], ...] = ((0.0, 0.0),),
    engine: str = "ideal-rk4",
    dt_s: float = 1e-3,
    horizon_s: float = SHORT,
    gains: Gains = PAPERS_GAINS,
) -> Plan:
    """Plan a map of each law from the same orientations, at speeds between the numbers of each pair [rad/s]."""
    whole = Unit("map", task="free-body", engine=engine, total=starts * len(speeds), horizon_s=horizon_s)
    units = (
        unit
        for one in laws
        for least, most in speeds
        for unit in replace(whole, contender=one.name, selector=f"speed-{least:g}to{most:g}").cut(starts, UNIT)
    )
    return Plan(Request("map", tuple(laws), gains, dt_s, seed=seed), tuple(units))


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return the cells that a unit's starts lie in, the slowest start of each ring, and the lost starts."""
    found = pd.DataFrame()
    for number in range(unit.first // BLOCK, -(-(unit.first + unit.count) // BLOCK)):
        made = _of_block(request, unit, number)
        found = made if found.empty else fold(found, made)
    return found


def _of_block(request: Request, unit: Unit, number: int) -> pd.DataFrame:
    from bench.engines.simulate import on_ideal

    one, first = request.contender(unit.contender), number * BLOCK
    least, most = map(float, unit.selector.removeprefix("speed-").split("to"))
    quats, omegas = (part[: unit.first + unit.count - first] for part in block(number, request.seed, most, least))
    ended = on_ideal(unit.engine, one, start_rows(quats, omegas), request.limits(unit.horizon_s), total=unit.total)
    codes, has_converged = ended[:, OUTCOME].astype(int), ended[:, STEP] >= 0.0
    is_settled = (ended[:, OUTCOME] == SETTLED) & has_converged
    starts = pd.DataFrame(
        {
            **dict(zip(PLACE, cells(quats), strict=True)),
            "starts": 1,
            "settled": is_settled.astype(np.int64),
            "unconverged": (~has_converged).astype(np.int64),
            "settling_time_s": np.where(is_settled, ended[:, SETTLING_TICK] * request.dt_s, np.nan),
            "start": first + np.arange(len(quats)),
            **dict(zip(STATE, np.column_stack((quats, omegas)).T, strict=True)),
            "outcome": np.array(OUTCOMES)[codes],
        }
    )
    every = pd.concat([starts.assign(row=row) for row in (CELL, SLOWEST, LOST)], ignore_index=True)
    law = {
        **one.words,
        "kp": request.gains.kp,
        "kv": request.gains.kv,
        "engine": unit.engine,
        "seed": request.seed,
        "least_speed": least,
        "most_speed": most,
    }
    is_settled_start = (every["row"] == LOST) & (every["settled"] == 1)
    return _reduced(every[~is_settled_start].assign(**law))


def start_rows(quats: np.ndarray, omegas: np.ndarray) -> np.ndarray:
    """Return starts of an engine, with the goal I: quaternion, omega, goal, haversine of the settling band."""
    made = np.empty((len(quats), START_WIDTH))
    made[:, :4], made[:, 4:7], made[:, 7:11] = quats, omegas, IDENTITY
    made[:, 11] = [RULES.band_haversine(angle(quat, IDENTITY)) for quat in quats.tolist()]
    return made


def cells(quats: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ring [deg], band and azimuth of quaternions (n, 4)."""
    w, x, y, z = np.where(quats[:, :1] < 0.0, -quats, quats).T
    ring = RINGS - 1 - np.searchsorted(EDGES[::-1], w)
    along = z / np.sqrt(x * x + y * y + z * z)
    band = np.clip(np.floor(0.5 * BANDS * (along + 1.0)), 0, BANDS - 1)
    azimuth = np.floor(AZIMUTHS * (np.arctan2(y, x) / math.tau + 0.5)) % AZIMUTHS
    return 5 * ring, band.astype(np.int64), azimuth.astype(np.int64)


def fold(before: pd.DataFrame, after: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of two stretches of starts, the first before the second, as those of both."""
    return _reduced(pd.concat([before, after], ignore_index=True))


def _reduced(every: pd.DataFrame) -> pd.DataFrame:
    """Sum cells; keep of each ring's slowest starts the slowest, the first of equals; the first MOST_LOST lost ones."""
    cells = every[every["row"] == CELL].assign(start=-1, outcome="", **dict.fromkeys(STATE, np.nan))
    how = {"starts": "sum", "settled": "sum", "unconverged": "sum", "settling_time_s": "max"} | dict.fromkeys(
        ("start", *STATE), "first"
    )
    cells = cells.groupby([*LAW, *PLACE, "row", "outcome"], sort=False, as_index=False).agg(how)
    slowest = every[(every["row"] == SLOWEST) & (every["settled"] == 1)]
    slowest = slowest.sort_values("settling_time_s", ascending=False, kind="stable")
    slowest = slowest.drop_duplicates([*LAW, "ring_deg"])
    lost = every[every["row"] == LOST].groupby(LAW, sort=False).head(MOST_LOST)
    order = [*LAW, "row", *PLACE, "start"]
    return pd.concat([cells, slowest, lost], ignore_index=True).sort_values(order, ignore_index=True)


def is_whole(request: Request, unit: Unit, rows: pd.DataFrame) -> bool:
    """Tell whether the cells hold as many starts as the unit has, none lie outside SO(3), and each row has its kind."""
    at = rows[rows["row"] == CELL]
    parts = rows[["starts", "settled", "unconverged"]]
    limits = {"ring_deg": 5 * RINGS, "band": BANDS, "azimuth": AZIMUTHS}
    is_counted = (parts >= 0).all(axis=None) and (parts["settled"] + parts["unconverged"] <= parts["starts"]).all()
    is_inside = all(rows[name].between(0, most - 1).all() for name, most in limits.items())
    has_kinds = rows["row"].isin((CELL, SLOWEST, LOST)) & ((rows["outcome"] == "") == (rows["row"] == CELL))
    return bool(at["starts"].sum() == unit.count and is_counted and is_inside and has_kinds.all())


EXPERIMENT = Experiment.of(
    globals(),
    "laws from millions of random starts",
    units=lambda request: (),
    cost_s=lambda unit: unit.count * START_S,
    prepare=lambda request, unit: prepare_law(request, unit, unit.engine, metrics=()),
    in_suites=False,
)

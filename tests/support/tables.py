"""Tables that a test has written or changed, claims judged on them, and the edits of planted_claims.toml."""

import functools
import math
from pathlib import Path

import numpy as np
import pandas as pd

from bench.experiments import sliding_motion
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.findings.claims import controller_costs, degeneracy
from bench.findings.claims.euler_jacobian import EPS, WELL_CONDITIONED
from bench.findings.claims.lopez_slotine_2024 import motions
from bench.findings.claims.standing import Operations
from bench.findings.claims.tables import Results
from support.claim_tables import YIELDS

NO_TIMINGS = Path("no-such-folder")


def judged(id: str, experiments=None, **tables: pd.DataFrame):
    """The verdict on these tables, and experiments if they are given; nothing was timed but what is among them."""
    return claims.judge(id, Results(None, tables, NO_TIMINGS, experiments=experiments))


def decided(verdict, word) -> bool:
    """Whether that is the verdict, on some rows and with a number for evidence."""
    texts = str(verdict.evidence), verdict.evidence.measured
    have_numbers = all(any(map(str.isdigit, text)) for text in texts)
    return verdict.word == word and verdict.rows > 0 and have_numbers


def changed(frame: pd.DataFrame, rows, **cells) -> pd.DataFrame:
    """The frame with some cells of some rows set, or turned by a function."""
    frame = frame.copy()
    for name, value in cells.items():
        if isinstance(frame[name].dtype, pd.CategoricalDtype):
            frame[name] = frame[name].astype(str)
        frame.loc[rows, name] = value(frame.loc[rows, name]) if callable(value) else value
    return frame


def table(name, folder="reference"):
    """Return a table of results with plain words and `law`."""
    found = pd.read_parquet(RESULTS / folder / f"{name}.parquet")
    found = found.astype(dict.fromkeys(found.select_dtypes("category").columns, str))
    if "regulator" in found:
        found["law"] = found["regulator"] + np.where(found["representation"] == "", "", "/") + found["representation"]
    return found


OTHER_ARM = {"puma560": "ur5e", "ur5e": "puma560"}
NAMES = {"EPS": EPS, "YIELDS": YIELDS, "WELL_CONDITIONED": WELL_CONDITIONED, "nan": math.nan, "pi": math.pi}
NAMES |= {"OTHER_ARM": OTHER_ARM}
"""What expressions name by @."""


def look_up(frame, text):
    """Return the value of an expression over the columns and a few more."""
    more = {"number": np.arange(len(frame))}
    if "contender" in frame or "regulator" in frame:
        own = frame if "representation" in frame else frame.assign(regulator=frame["contender"], representation="")
        form = own["representation"].astype(str)
        more["law"] = own["regulator"].astype(str) + np.where(form == "", "", "/") + form
    if {"alpha", "beta", "gamma"} <= {*frame}:
        degrees = np.degrees(frame[["alpha", "beta", "gamma"]]).round().astype(int).astype(str)
        more["at"] = degrees.agg(" ".join, axis=1)
    if "beta" in frame:
        more["lean"] = np.degrees(frame["beta"]).round(6)
    return frame.assign(**more).eval(text, engine="python", local_dict=NAMES)


def of_bend(table):
    """Return C20's experiments: the bend of an angle at 1 ms, first order in the step; what is left at step zero."""
    one = table.iloc[0]

    def curves(word, arm, gains, dt_s, count):
        number = {"bend_0": one.bend * dt_s / 1e-3 + one.second, "bend_1": 0.0, "bend_2": 0.0}
        return pd.DataFrame([number | {"start_id": "clear-0", "time_s": t} for t in (0.0, 0.02)]).assign(
            position_error_m=one.drift
        )

    def beside_poles(word, arm, found, gains):
        outcome = "settled" if word.startswith("rotation-matrix") else one.beside
        return pd.DataFrame({"start_id": ["0-plus-exact"], "outcome": [outcome], "peak_tau_nm": [30.0]})

    bends = functools.partial(controller_costs.bend.__wrapped__, curves=curves)
    return {"bend": bends, "beside_poles": beside_poles}


def of_ways(table):
    one = table.iloc[0]
    found = np.array([1.0, one.ends]), [one.loops * a * a for a in degeneracy.LOOPS_RAD], one.plane
    return {"ways": lambda seed: found}


def of_heavier(table):
    """Return C30's: feedback linearization slowed by so much and losing so many of 100 at twice the inertia."""
    one = table.iloc[0]

    def perturbed(law, *_):
        levels = np.repeat((1.0, 2.0), 100)
        frame = pd.DataFrame({"level": levels, "outcome": "settled", "settling_time_s": 1.0})
        if law != "rotation-matrix":
            frame.loc[frame["level"] == 2.0, "settling_time_s"] = one.slow
            frame.loc[frame.index[100 : 100 + int(one.lost)], ["outcome", "settling_time_s"]] = ["timed-out", math.nan]
        return frame

    return {"perturbed": perturbed}


def of_counts(table):
    """Return C33's: the controller on the Euler Jacobian, beside another of 900 flops."""
    counts = table.set_index("joints")

    def in_contact(controller, joints):
        is_euler = controller_costs.EULER in controller
        return Operations(*(counts.loc[joints, ["flops", "calls"]] if is_euler else (900, 0)))

    return {"in_contact": in_contact}


def of_record(name, kind):
    """Return a reader of a table of one row: the experiment of this name finds the row as a record of this kind."""
    return lambda table: {name: lambda *_: kind(**table.iloc[0].to_dict())}


EXPERIMENTS = {
    "decay": of_record("measure_decay", sliding_motion.Decay),
    "bound": of_record("measure_bound", sliding_motion.Bounded),
    "both_frames": of_record("compare_frames", motions.Frames),
    "hold": of_record("hold_by_noise", motions.Hold),
    "balance": lambda table: {"experiment": lambda: (table, [EPS])},
    "bend": of_bend,
    "ways": of_ways,
    "heavier": of_heavier,
    "in_contact": of_counts,
}

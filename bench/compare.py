"""The regression gate: a run against the reference, row by row.

Schema, row keys, outcomes and operation counts must be the same exactly; a settling time to less than half a tick;
other numbers of settled episodes to RELATIVE. Numbers of an episode that failed are not compared, its cause among
them: on its way it may pass a singular point, where the last bit of a library's sine decides them.

An arm has more such points. Joint accelerations J^-1 (u - Jdot qdot) have the condition number of J twice, in J^-1 and
in qdot, so on an arm tolerances grow with its square once it leaves WELL_CONDITIONED; and where in both runs it went
beyond UNDECIDED, rounding has decided the outcome, which is then not compared.

In contact rounding decides for coordinates whose singular set the goal lies on, and for a hand that was THROWN about.
"""

from pathlib import Path

import numpy as np
import pandas as pd

from bench.discovery import known_representations
from bench.errors import BadResults
from bench.representations.zyx_euler import to_matrix
from bench.schema import COMPLIANCE_KEY, KEY, ROBUSTNESS_KEY
from bench.store import read, read_arrow
from tasks.verdict import OUTCOMES, SETTLED

RELATIVE = 1e-6
"""Rounding grows by less than a millionth in a settled episode: two libraries' sines (1e-16 apart) and some 1e4 ticks
leave 1e-12; step-size effects that a change of code could bring start at 1e-4."""

ABSOLUTE = 1e-9
"""Below this an angle [rad] or a margin is rounding itself."""

WELL_CONDITIONED = 1e3
"""Condition number of an arm's Jacobian up to which RELATIVE holds: the 1e-12 above times its square."""

UNDECIDED = 1e6
"""Condition number whose square makes 1e-12 into everything."""

COST_KEY = ("regulator", "representation", "jacobian", "inverse", "joints", "branch", "stage")
BOUNDARY_KEY = ("regulator", "representation", "jacobian", "inverse", "axis_x", "axis_y", "axis_z")
BOUNDARY_ANGLE = 1e-5
"""Bisection ends at 7e-7 rad; near a fractal boundary the last steps may go either way."""

TRACE_KEY = (
    *("task", "arm", "regulator", "representation", "jacobian", "inverse"),
    *("engine", "start_set", "start_id", "time_s"),
)
ARRIVED = 0.02
"""A curve whose angle ends below the settling band's share of where it began came to the goal."""

POSE_KEY = ("arm", "pose_set", "pose_id", "representation")
POSE_RELATIVE = 1e-5
"""Single precision is 6e-8; condition numbers up to STEADY lose half the digits of the doubles they are made of."""

STEADY = 1e8
"""Condition number beyond which the last bit of a joint angle decides its value."""

ON_SET = 1e-6
"""Margin of coordinates: a goal that is nearer to their singular set is meant to be on it."""

THROWN = 1.0
"""Torque over its rated one: a hand that asks more of its motors has been thrown about; what it hits next, and when,
hangs on rounding."""

CONTACT_RELATIVE, CONTACT_ABSOLUTE = 1e-4, 1e-7
"""Impacts multiply rounding: 1e-16 in a joint angle becomes 4e-7 in the peak of the force on a peg that jams, and each
tick rounds anew. A rotation [rad] by its cosine is known to 2e-8."""

TROUBLED_RELATIVE = 1e-4
"""A law that jumps at half turns, asked there with noise, chooses its side by the last bit; what settles all the same
has been driven on by its goal or its noise for five thousand steps."""

SHOWN = 10


def compare(candidate: Path, reference: Path) -> list[str]:
    """What differs, one line each; empty if nothing does.

    Errors:
        BadResults: a folder holds no finished run.
    """
    lines = []
    for table, rows in TABLES.items():
        try:
            old, new = read(reference, table), read(candidate, table)
        except BadResults as error:
            raise BadResults(f"nothing to compare: {error}") from error
        schema = _schema(table, candidate, reference)
        lines += schema or rows(new, old)
    return lines


def _schema(table: str, candidate: Path, reference: Path) -> list[str]:
    """Columns, types and units that differ."""
    found, wanted = (_fields(folder / f"{table}.parquet", table) for folder in (Path(candidate), Path(reference)))
    lines = [f"{table}: column {name} is missing" for name in wanted if name not in found]
    lines += [f"{table}: column {name} is new" for name in found if name not in wanted]
    for name in wanted:
        if name in found and found[name] != wanted[name]:
            lines.append(f"{table}: column {name} is {_typed(found[name])}, was {_typed(wanted[name])}")
    if not lines and list(found) != list(wanted):
        lines.append(f"{table}: the columns come in another order")
    return lines


def _fields(path: Path, table: str) -> dict:
    return {
        field.name: (str(field.type), (field.metadata or {}).get(b"unit", b"").decode())
        for field in read_arrow(path, table).schema
    }


def _typed(field: tuple[str, str]) -> str:
    return f"{field[0]} [{field[1]}]"


def _aligned(table: str, new: pd.DataFrame, old: pd.DataFrame, key) -> tuple[pd.DataFrame, pd.DataFrame, list[str]]:
    """The rows that both have, in one order, and a line for each that only one has."""
    new, old = (_keyed(frame, key) for frame in (new, old))
    lines = []
    for name, frame in (("candidate", new), ("reference", old)):
        twice = frame.index[frame.index.duplicated()].unique()
        lines += _some(f"{table}: row twice in the {name}", list(twice))
    if lines:
        return new.iloc[:0], old.iloc[:0], lines
    lines += _some(f"{table}: row is missing", list(old.index.difference(new.index, sort=False)))
    lines += _some(f"{table}: row is new", list(new.index.difference(old.index, sort=False)))
    both = old.index.intersection(new.index, sort=False)
    return new.loc[both], old.loc[both], lines


def _keyed(frame: pd.DataFrame, key) -> pd.DataFrame:
    rows = frame[list(key)].astype(str).itertuples(index=False)
    return frame.set_axis(pd.Index([" ".join(filter(None, row)) for row in rows], dtype=str), axis=0)


def _some(what: str, names: list[str]) -> list[str]:
    lines = [f"{what}: {name}" for name in names[:SHOWN]]
    return lines + ([f"{what}: ... and {len(names) - SHOWN} more"] if len(names) > SHOWN else [])


def _episodes(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    new, old, lines = _aligned("episodes", new, old, KEY)
    settled = old["outcome"].astype(str) == OUTCOMES[SETTLED]
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    # NaN on the free body, which has no Jacobian and is well conditioned everywhere
    condition = np.fmax(1.0, np.fmin(new["cond_jacobian_max"].to_numpy(), old["cond_jacobian_max"].to_numpy()))
    decided = condition <= UNDECIDED
    lines += _changed("outcome", new, old, ~same & decided)
    both = settled & same & decided
    relative = RELATIVE * np.clip(condition, WELL_CONDITIONED, UNDECIDED) ** 2 / WELL_CONDITIONED**2
    for name in old.columns.difference([*KEY, "outcome", "cause"], sort=False):
        if old[name].dtype.kind not in "iuf":
            lines += _changed(name, new, old, new[name].astype(str) != old[name].astype(str))
            continue
        a, b = new[name].to_numpy(float), old[name].to_numpy(float)
        if name in ("settling_time_s", "failure_time_s"):
            close = np.abs(a - b) < 0.5 * old["dt_s"].to_numpy() + (relative - RELATIVE) * b
        elif name == "ticks":
            close = np.abs(a - b) <= (relative - RELATIVE) * b
        else:
            close = np.isclose(a, b, rtol=relative, atol=ABSOLUTE)
        lines += _changed(name, new, old, both & ~(close | (np.isnan(a) & np.isnan(b))))
    return lines


def _changed(name: str, new: pd.DataFrame, old: pd.DataFrame, rows) -> list[str]:
    picked = new.index[np.asarray(rows)]
    lines = [f"{name}: {old.at[key, name]} -> {new.at[key, name]}: {key}" for key in picked[:SHOWN]]
    return lines + ([f"{name}: ... and {len(picked) - SHOWN} more rows"] if len(picked) > SHOWN else [])


def _costs(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    new, old, lines = _aligned("costs", new.assign(joints=_words(new)), old.assign(joints=_words(old)), COST_KEY)
    for name in old.columns.difference(COST_KEY, sort=False):
        lines += _changed(name, new, old, new[name].to_numpy() != old[name].to_numpy())
    return lines


def _words(costs: pd.DataFrame) -> pd.Series:
    """Joints as a row's name says them: nothing of a law alone."""
    return costs["joints"].map(lambda joints: f"{joints} joints" if joints else "")


def _boundaries(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    new, old, lines = _aligned("boundaries", new.round(_digits(new)), old.round(_digits(old)), BOUNDARY_KEY)
    for name in ("settled_to_rad", "fails_from_rad"):
        a, b = new[name].to_numpy(float), old[name].to_numpy(float)
        close = np.isclose(a, b, rtol=0.0, atol=BOUNDARY_ANGLE, equal_nan=True)
        lines += _changed(name, new, old, ~close)
    return lines


def _traces(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    """Samples of the curves that end at the goal; which curves there are, of all."""
    curves = [frame.groupby(list(TRACE_KEY[:-1]), observed=True)["angle_rad"] for frame in (new, old)]
    names = [{" ".join(filter(None, map(str, key))) for key in one.groups} for one in curves]
    lines = _some("traces: curve is missing", sorted(names[1] - names[0]))
    lines += _some("traces: curve is new", sorted(names[0] - names[1]))
    if lines:
        return lines
    arrived = [one.transform("last") <= ARRIVED * one.transform("first") for one in curves]
    new, old, lines = _aligned("traces", new[arrived[0]], old[arrived[1]], TRACE_KEY)
    for name in old.columns.difference([*TRACE_KEY, "outcome"], sort=False):  # a curve that arrives has settled
        a, b = new[name].to_numpy(float), old[name].to_numpy(float)
        lines += _changed(name, new, old, ~np.isclose(a, b, rtol=RELATIVE, atol=RELATIVE, equal_nan=True))
    return lines


def _poses(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    """Poses and what their Jacobians are; the gaps are rounding itself, and claims look at their size."""
    new, old, lines = _aligned("poses", new, old, POSE_KEY)
    steady = (old["condition_analytic"].to_numpy() < STEADY) & (old["condition"].to_numpy() < STEADY)
    for name in old.columns.difference(POSE_KEY, sort=False):
        if not name.endswith("_gap"):
            a, b = new[name].to_numpy(float), old[name].to_numpy(float)
            close = np.isclose(a, b, rtol=POSE_RELATIVE, atol=ABSOLUTE, equal_nan=True)
            lines += _changed(name, new, old, steady & ~close)
    return lines


def _compliance(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    new, old, lines = _aligned("compliance", new, old, COMPLIANCE_KEY)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    torque = np.fmin(new["peak_torque_ratio"].to_numpy(), old["peak_torque_ratio"].to_numpy())
    decided = ~_on_singular_set(old) & ~(torque > THROWN)
    lines += _changed("outcome", new, old, ~same & decided)
    both = same & decided & (old["outcome"].astype(str) == "done")
    for name in old.columns.difference([*COMPLIANCE_KEY, "outcome"], sort=False):
        if old[name].dtype.kind in "iuf":
            a, b = new[name].to_numpy(float), old[name].to_numpy(float)
            close = np.isclose(a, b, rtol=CONTACT_RELATIVE, atol=CONTACT_ABSOLUTE, equal_nan=True)
            lines += _changed(name, new, old, both & ~close)
        else:
            lines += _changed(name, new, old, new[name].astype(str) != old[name].astype(str))
    return lines


def _robustness(new: pd.DataFrame, old: pd.DataFrame) -> list[str]:
    new, old, lines = _aligned("robustness", new, old, ROBUSTNESS_KEY)
    same = new["outcome"].astype(str) == old["outcome"].astype(str)
    lines += _changed("outcome", new, old, ~same)
    settled = same & (old["outcome"].astype(str) == OUTCOMES[SETTLED])
    for name in old.columns.difference([*ROBUSTNESS_KEY, "outcome"], sort=False):
        a, b = new[name].to_numpy(float), old[name].to_numpy(float)
        close = np.isclose(a, b, rtol=TROUBLED_RELATIVE, atol=ABSOLUTE, equal_nan=True)
        lines += _changed(name, new, old, settled & ~close)
    return lines


def _on_singular_set(rows: pd.DataFrame) -> np.ndarray:
    """Whether a row's goal is where its controller's coordinates are singular."""
    margins = {name: one.margin for name, one in known_representations().items()}
    goals = zip(rows["representation"].astype(str), rows["alpha"], rows["beta"], rows["gamma"], strict=True)
    return np.array([bool(name) and margins[name](to_matrix(E)) < ON_SET for name, *E in goals], bool)


def _digits(frame: pd.DataFrame) -> dict[str, int]:
    """Axes are compared by their first nine digits: they name a row."""
    return {name: 9 for name in frame.columns if name.startswith("axis_")}


TABLES = {
    "episodes": _episodes,
    "costs": _costs,
    "boundaries": _boundaries,
    "poses": _poses,
    "compliance": _compliance,
    "robustness": _robustness,
    "traces": _traces,
}
"""What is compared, and how."""

"""The exception that a user's law raises at a start, found by plain calls in a process of its own."""

from pathlib import Path

import pandas as pd

from bench.base.errors import BadLaw
from bench.base.isolated import TimeLimits
from bench.law.contenders.law_file import load_law
from bench.law.contenders.law_process import answer, ask
from bench.law.contenders.registry import contenders_of
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.kinds import Law
from bench.law.so3 import from_quaternion

LIMITS = TimeLimits(processor_s=10.0, wall_s=60.0)
"""Time limits for the calls."""


def find_exception(law: Law, rows: pd.DataFrame) -> str:
    """Return the first exception at the starts of some episodes, as "ValueError: too far"; empty if there is none."""
    columns = [f"{prefix}quat_{part}" for prefix in ("", "goal_") for part in "wxyz"]
    asked = {"text": law.text, "origin": law.origin, "starts": rows[columns].to_numpy().tolist()}
    try:
        return str(ask(__name__, asked, LIMITS, law.origin).get("raised", ""))
    except BadLaw as error:
        return str(error)


def call_law(asked: dict, path: Path | None) -> dict[str, str]:
    """Call the law at rest at each start, and return the first exception."""
    [contender, *_] = contenders_of(load_law(path or Path(), asked["text"].encode()))
    memory = () if contender.regulator.memory is None else (contender.regulator.memory,)
    for start in asked["starts"]:
        R, R_d = from_quaternion(tuple(start[:4])), from_quaternion(tuple(start[4:]))
        try:
            contender.law(R, AT_REST, Goal(R_d, AT_REST, AT_REST), Tuning(), *memory)
        except Exception as error:
            return {"raised": f"{type(error).__name__}: {error}"}
    return {}


if __name__ == "__main__":
    answer(call_law)

"""What a column and a table are, and the columns that tables of several experiments share."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from tasks.verdict import CRASHED, OUTCOMES

if TYPE_CHECKING:
    import pyarrow as pa

VERSION = "2"
WORD, NUMBER, COUNT, SINGLE = "word", "double", "int64", "float"
"""Types of columns: of a word, as parquet's dictionary; of others, their names in Arrow. SINGLE is where seven digits
are enough: sizes of what is nearly zero, condition numbers, measures of robustness."""


class Column(NamedTuple):
    """One column of a table."""

    name: str
    type: str
    unit: str
    meaning: str


def words(**meanings: str) -> list[Column]:
    """Return columns of words."""
    return [Column(name, WORD, "", meaning) for name, meaning in meanings.items()]


def counts(**meanings: str) -> list[Column]:
    """Return columns of whole numbers."""
    return [Column(name, COUNT, "1", meaning) for name, meaning in meanings.items()]


def singles(**meanings: tuple[str, str]) -> list[Column]:
    """Return columns of single precision, each from its unit and meaning."""
    return [Column(name, SINGLE, unit, meaning) for name, (unit, meaning) in meanings.items()]


def numbers(unit: str, meaning: str, *names: str) -> list[Column]:
    """Return columns of numbers with the same unit and meaning."""
    return [Column(name, NUMBER, unit, meaning) for name in names]


class Table(NamedTuple):
    """A table: the file <name>.parquet.

    columns() -> its columns, in order; they may depend on what metrics there are. key: the columns that name a row.
    """

    name: str
    columns: Callable[[], list[Column]]
    key: tuple[str, ...]

    @property
    def names(self) -> list[str]:
        """Return the names of the columns."""
        return [one.name for one in self.columns()]

    def schema(self) -> pa.Schema:
        """Return the schema of the parquet file, with units and meanings as the columns' metadata."""
        import pyarrow as pa  # names of tables and columns need it not

        types = {WORD: pa.dictionary(pa.int32(), pa.string())}
        types |= {name: pa.type_for_alias(name) for name in (NUMBER, COUNT, SINGLE)}
        fields = [
            pa.field(one.name, types[one.type], metadata={"unit": one.unit, "meaning": one.meaning})
            for one in self.columns()
        ]
        return pa.schema(fields, metadata={"orientation-bench table": self.name, "orientation-bench schema": VERSION})


CONTENDER = words(
    regulator="the law",
    representation="coordinates the law acts on; empty for a law on R",
    jacobian="Jacobian of the arm; empty for the free body",
    inverse="how the Jacobian is inverted; empty for the free body",
)
CONTENDER_KEY = tuple(one.name for one in CONTENDER)
"""The columns that name a contender."""

SUITE = words(suite="plan the row belongs to")
ARM = words(arm="manipulator; empty for the free body")
START = words(start_set="family of starts", start_id="start within its family")
ANGLE0 = numbers("rad", "initial angle to the goal, by the judge", "angle0_rad")
GAINS = [*numbers("1/s^2", "position gain", "kp"), *numbers("1/s", "velocity gain", "kv")]
DT = numbers("s", "control period", "dt_s")
STEPPED_DT = numbers("s", "control period and integration step", "dt_s")
HORIZON = numbers("s", "longest time simulated", "horizon_s")
JOINTS = numbers("rad", "joint angles; null where there is no such joint", *(f"q_{i}" for i in range(1, 8)))
JUDGED = [
    *words(outcome=f"{', '.join(OUTCOMES[:CRASHED])}; of a user's law also {' or '.join(OUTCOMES[CRASHED:])}"),
    *numbers("s", "first time after which the angle stays in the band; null if it does not", "settling_time_s"),
    *numbers("s", "time at which the episode failed; null if it did not", "failure_time_s"),
    *numbers("rad", "angle to the goal at the end, by the judge", "final_angle_rad"),
]
"""How an episode ended."""
LEVEL = [
    *words(
        axis="perturbation: python -m bench list axes",
        regulator="the law",
        representation="coordinates the law acts on; empty for a law on R",
    ),
    *numbers("the axis's", "how much of it", "level"),
]
"""The columns that name a law at a level of a perturbation."""
LEVEL_KEY = ("axis", "level", "regulator", "representation")

"""One benchmark of one build: a line of the history.

A line is a JSON object with these fields, all of them, and no other:

    schema      "orientation-bench history 1"
    commit      forty hex digits
    date        of the commit, UTC, as 2026-11-21T20:15:00Z
    place       how many commits lead to it: what orders commits of one second
    machine     processor and number of cores, as names of files in results/timings
    compiler    digest of the packages' versions and of what the compiler may use of the processor
    benchmark   a measurement as `bench.regression.revisions.measurement` writes it: name, what, kernel_steps, rounds,
                instructions, operations, code
"""

import hashlib
import json
import re
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from bench.errors import BadResults
from bench.regression.revisions import measurement
from bench.regression.revisions.comparison import Comparison
from bench.regression.revisions.measurement import ENGINE, LAW, Measurement
from bench.regression.revisions.self_measure import SelfMeasure

SCHEMA = "orientation-bench history 1"
FIELDS = ("schema", "commit", "date", "place", "machine", "compiler", "benchmark")
COMMIT = re.compile(r"[0-9a-f]{40}")
DATE = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ")
WORD = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
DIGEST = re.compile(r"[0-9a-f]{16}")
NAME = re.compile(r"[A-Za-z0-9 /@+-]{1,100}")
CODE = re.compile(r"[0-9a-f]{0,64}")


class Commit(NamedTuple):
    """A commit, and where it stands in the history; see the module."""

    commit: str
    date: str
    place: int


class Record(NamedTuple):
    """What one build measured of one benchmark; see the module."""

    commit: str
    date: str
    place: int
    machine: str
    compiler: str
    benchmark: Measurement

    @property
    def key(self) -> tuple[str, str, str, str]:
        """What no two lines share."""
        return self.commit, self.machine, self.benchmark.what, self.benchmark.name


def of_self_measure(given: SelfMeasure, at: Callable[[str], Commit]) -> list[Record]:
    """The lines of a checkout that measured itself.

    Args:
        at: finds the commit of that name.
    Errors:
        BadResults: its sources are no commit's.
    """
    if given.dirty or not COMMIT.fullmatch(given.commit):
        raise BadResults("this checkout has changes that no commit holds, and a history holds commits; commit them")
    return _lines(at(given.commit), given.machine, given.measurements)


def of_comparison(given: Comparison, side: str, at: Callable[[str], Commit]) -> list[Record]:
    """The lines of one side of a comparison.

    Args:
        side: "base" or "head". at: finds the commit of that name.
    Errors:
        BadResults: the side is no commit; a history names commits.
    """
    which = given.head if side == "head" else given.base
    if not COMMIT.fullmatch(which.commit):
        raise BadResults(f"'{which.name}' of this comparison is no commit, and a history holds commits; commit it")
    measured = (getattr(one, side) for one in given.benchmarks)
    return _lines(at(which.commit), given.machine, (one for one in measured if one is not None))


def _lines(at: Commit, machine: dict[str, Any], measured: Iterable[Measurement]) -> list[Record]:
    with_what = [machine[name] for name in ("versions", "target")]
    compiler = hashlib.sha256(json.dumps(with_what, sort_keys=True).encode()).hexdigest()[:16]
    return [Record(*at, machine["key"], compiler, one) for one in measured]


def to_json(line: Record) -> str:
    """The line as it stands in the file, without its end."""
    content = {"schema": SCHEMA, **line._asdict(), "benchmark": line.benchmark.as_json()}
    return json.dumps(content, sort_keys=True, separators=(",", ":"))


def from_json(text: str) -> Record:
    """The line that `to_json` wrote.

    Errors:
        BadResults: what is wrong with it.
    """
    try:
        given = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise BadResults(f"no JSON ({error})") from error
    if not isinstance(given, dict) or given.get("schema") != SCHEMA:
        raise BadResults(f"no object of schema '{SCHEMA}'")
    if set(given) != set(FIELDS):
        raise BadResults(f"its fields are {', '.join(sorted(given))}; a line has {', '.join(sorted(FIELDS))}")
    for name, form in (("commit", COMMIT), ("date", DATE), ("machine", WORD), ("compiler", DIGEST)):
        _match(name, given[name], form)
    if type(given["place"]) is not int or given["place"] < 1:
        raise BadResults(f"place is {given['place']!r}; a whole number from 1 on")
    return Record(**{name: given[name] for name in FIELDS[1:-1]}, benchmark=_measurement(given["benchmark"]))


def _match(name: str, value: Any, form: re.Pattern) -> None:
    if not (isinstance(value, str) and form.fullmatch(value)):
        raise BadResults(f"{name} is {value!r}, which is not of the form {form.pattern}")


def _measurement(given: Any) -> Measurement:
    """A measurement, every field looked at: a file of lines may come from anywhere."""
    if not isinstance(given, dict) or set(given) != set(Measurement._fields):
        raise BadResults(f"its benchmark lacks fields or has foreign ones; it has {', '.join(Measurement._fields)}")
    _match("name", given["name"], NAME)
    _match("code", given["code"], CODE)
    if given["what"] not in (LAW, ENGINE):
        raise BadResults(f"what is {given['what']!r}; known: {LAW}, {ENGINE}")
    spread, operations = given["kernel_steps"], given["operations"]
    if not (spread is None or (isinstance(spread, list) and len(spread) == 3 and all(map(_is_positive, spread)))):
        raise BadResults(f"kernel_steps is {spread!r}; three positive numbers, or null")
    if not (given["instructions"] is None or _is_positive(given["instructions"])):
        raise BadResults(f"instructions is {given['instructions']!r}; a positive number, or null")
    if type(given["rounds"]) is not int or given["rounds"] < 0:
        raise BadResults(f"rounds is {given['rounds']!r}; a whole number")
    if not isinstance(operations, dict) or not all(map(_is_tally, operations.values())):
        raise BadResults("operations is no object of branches, each an object of whole numbers")
    for branch, tally in operations.items():
        for word in (branch, *tally):
            _match("an operation", word, re.compile(r"[a-z0-9_-]{1,40}"))
    return measurement.from_json(given)


def _is_positive(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and 0.0 < value < 1e12


def _is_tally(value: Any) -> bool:
    return isinstance(value, dict) and all(type(count) is int and 0 <= count < 10**9 for count in value.values())

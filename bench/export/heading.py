"""What every exported file says first: what it is, where it fails, what it costs, and where it is from."""

import re
import sys
import textwrap
import tomllib
from typing import Any

from bench.counting.costs import FLOPS, cost
from bench.counting.counted import TOTAL
from bench.export.subject import IMPEDANCE, POSE_SPRING, SPRING, STATED, Subject
from bench.law.contender import Regulator
from bench.provenance import ROOT

WIDTH = 110
GAINS = "Gains     kp [1/s^2], kv [1/s]; "
OF_KIND = {
    STATED: (
        f"{GAINS}what they set is in the formula",
        "State     four numbers; begin gives the first of them, next_state those of every period after",
    ),
    IMPEDANCE: (f"{GAINS}apparent inertia [kg m^2]; stiffness at the goal kp times that",),
    POSE_SPRING: (
        "Pose      R, p: R_d^T R and R_d^T (p - p_d); eta, epsilon, phi: quaternion and rotation vector of R",
    ),
    SPRING: ("Turn      eta, epsilon: the quaternion of R_d^T R, eta >= 0; phi: its rotation vector",),
}
"""What else is said of a kind that is no regulator."""


def heading(subject: Subject) -> str:
    """Lines of plain text, for a comment."""
    record = subject.record
    of = f" in {subject.representation.title}" if subject.representation else ""
    lines = [
        f"{record.title}{of} ({subject.word})",
        "",
        f"Formula   {record.formula}",
        *([f"Source    {record.source}"] if record.source else []),
        *_facts(subject),
        "Frames    base frame; what ends in _body is in the body's. R: columns are the body's axes in the base frame",
        *_field("Entries", "; ".join(_entry_lines(subject))),
        f"Made by   orientation-bench {_version()} from the law's one source; licence Apache-2.0",
    ]
    return "\n".join(lines)


def _facts(subject: Subject) -> list[str]:
    lines = []
    if subject.contender is not None:
        regulator: Regulator = subject.record
        lines += [
            f"{GAINS}near the goal u = kp (rotation vector to the goal) - kv omega",
            f"Property  {regulator.property}",
            f"Cost      {_cost(subject)}",
        ]
        if subject.memory is not None:
            first = ", ".join(map(repr, subject.memory))
            lines.append(f"Memory    four numbers from tick to tick, at first ({first})")
    else:
        lines += (line for kind, said in OF_KIND.items() if subject.word.startswith(kind) for line in said)
        if hasattr(subject.record, "property"):
            lines.append(f"Property  {subject.record.property}")
    texts = [sys.modules[one.__module__].__doc__ or "" for one in _functions(subject.record)]
    fails = failures(texts[0]) if texts else ""
    return [*lines, *_field("Fails", fails)] if fails else lines


def _functions(record: Any) -> list:
    """The functions of a record, that of the law first: its module says where it fails."""
    found = (getattr(record, name, None) for name in ("law", "law_in", "chart", "moment", "wrench"))
    return [one for one in found if one is not None]


def failures(text: str) -> str:
    """What a module says after 'Fails:', on one line; empty if it says nothing."""
    found = re.search(r"Fails: (.*?)(?:\n\n|\Z)", text, re.DOTALL)
    return " ".join(found.group(1).split()) if found else ""


def _cost(subject: Subject) -> str:
    counted = cost(subject.contender).typical.of(TOTAL)
    flops = sum(counted[name] for name in FLOPS)
    calls = sum(counted[name] for name in ("sin", "cos", "atan2", "acos"))
    return f"{flops} flops and {calls} calls of sin, cos, atan2, acos in the typical branch of the command"


def _entry_lines(subject: Subject) -> list[str]:
    """Each kind of entry once: those of the base frame, by a matrix."""
    plain = [one for one in subject.entries if not re.search(r"_body|_wxyz|_xyzw", one.name)]
    return [f"{one.name}: {one.doc}" for one in plain]


def _field(name: str, text: str) -> list[str]:
    return textwrap.wrap(f"{name:<10}{text}", WIDTH, subsequent_indent=" " * 10)


def _version() -> str:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]


def summary(text: str) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join(text.partition("\n\n")[0].split())

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

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
HOLDER = PROJECT["authors"][0]["name"]
WIDTH = 110
RESET = (
    "Call reset before the first tick, after a pause, and whenever the goal jumps: the memory outlives the goal, and "
    "the side that was right for the last goal may be the longer way to the new one."
)
SIDE = (
    "The side is followed from tick to tick, so the measured orientation must turn by less than 180° between two "
    "ticks: e + phi/2 < 90°, where e is the error of the measured orientation and phi the rotation within a tick. What "
    "is said of noise needs this too."
)
"""What a user of any law with memory must know."""

BY_ROWS = (
    "Matrices  nine numbers by rows: R[3*i+j] is in row i and column j. What is stored by columns (Eigen's data(), "
    "OpenGL, O_T_EE of libfranka, the observation R of this project's tasks) must be transposed first"
)
UNFUSED = (
    "Digits    equal to the test vectors bit for bit where the compiler fuses no product with a sum "
    "(-ffp-contract=off and no -march); with -march=native or on aarch64 the last digits may differ"
)
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


def heading(subject: Subject, *notes: str) -> str:
    """Lines of plain text, for a comment.

    Args:
        notes: what is said of one language, each after its padded name.
    """
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
        *(line for note in notes for line in _field("", note)),
        f"Made by   orientation-bench {PROJECT['version']} from the law's one source",
        f"SPDX-FileCopyrightText: {HOLDER}",
        "SPDX-License-Identifier: Apache-2.0",
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
            lines += _field("Memory", f"the error quaternion of the last tick, at first ({first}). {RESET} {SIDE}")
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
    return textwrap.wrap(
        f"{name:<10}{text}" if name else text, WIDTH, subsequent_indent=" " * 10, break_on_hyphens=False
    )


def summary(text: str) -> str:
    """The first paragraph of a docstring, on one line."""
    return " ".join(text.partition("\n\n")[0].split())

"""Headings of exported files: formula, source, limitations, cost and licence."""

import importlib.metadata
import re
import sys
import textwrap

from bench.base.provenance import IS_CHECKOUT, ROOT, describe_project
from bench.engines.counting.costs import FLOPS
from bench.engines.counting.counted import TOTAL
from bench.experiments.costs import count_operations
from bench.export.subject import COMPENSATOR, IMPEDANCE, SPRING, Subject
from bench.law.attribution import describe_source
from bench.law.inputs import reads_limits
from bench.law.kinds import OnCoordinates

PROJECT = describe_project()
LICENSE = (
    (ROOT / "LICENSE").read_text(encoding="utf-8")
    if IS_CHECKOUT
    else importlib.metadata.distribution("orientation-bench").read_text("licenses/LICENSE") or ""
)
WIDTH = 110
RESET = (
    "Call reset before the first tick and after a pause. The memory outlives the goal: when the goal jumps, the side "
    "that was right for the last goal may be the longer way to the new one. A reset then shortens the path and saves "
    "no time."
)
SIDE = (
    "The side is followed from tick to tick, so the measured orientation must turn by less than 180° between two "
    "ticks: phi + 2 e < 180°, phi the rotation within a tick, e the angle from the measured to the true one. The "
    "results with noise need this too."
)
"""What a user of a law with memory must know."""

BY_ROWS = (
    "Matrices  nine numbers by rows: R[3*i+j] is in row i and column j. What is stored by columns (Eigen's data(), "
    "OpenGL, O_T_EE of libfranka, the observation R of this project's tasks) must be transposed first"
)
FRAMES = (
    "Frames    base frame; body frame where a name ends in _body; quaternions (w, x, y, z) where it ends in _wxyz. "
    "R: columns are the body's axes in the base frame"
)
UNFUSED = (
    "Digits    equal to the test vectors bit for bit where the compiler fuses no product with a sum "
    "(-ffp-contract=off and no -march); with -march=native or on aarch64 the last digits may differ"
)
GAINS = "Gains     kp [1/s^2], kv [1/s]; "
MOTORS = (
    "Motors    bound: greatest length of u that they carry out [rad/s^2]; delay: from a measurement to its effect [s]"
)
OF_KIND = {
    COMPENSATOR: (
        f"{GAINS}what they set is in the formula",
        "State     four numbers; reset returns the first of them, next_state those of every period after",
    ),
    IMPEDANCE: (f"{GAINS}apparent inertia [kg m^2]; stiffness at the goal kp times that",),
    SPRING: (
        "Pose      R, p: R_d^T R and R_d^T (p - p_d); eta >= 0, epsilon, phi: quaternion and rotation vector of R",
    ),
}
"""Lines of a kind that is no regulator."""


def heading(subject: Subject, *notes: str) -> str:
    """Return the heading as lines of plain text, for a comment; notes: on the language, each after its padded name."""
    record = subject.record
    of = f" in {subject.representation.title}" if subject.representation else ""
    law = getattr(record, "law", None)
    if isinstance(law, OnCoordinates):
        law = law.law_in
    functions = (law, *(getattr(record, name, None) for name in ("law_in", "chart", "moment")))
    module = sys.modules[next(filter(None, functions)).__module__].__doc__ or ""
    limits = re.search(r"Limitations: (.*?)(?:\n\n|\Z)", module, re.DOTALL)
    entries = "; ".join(f"{one.name}: {one.doc}" for one in subject.entries if not one.name.endswith("_body"))
    lines = [
        f"{record.title}{of} ({subject.word})",
        "",
        f"Formula   {record.formula}",
        *_wrapped(f"Source    {_attributed(subject)}" if record.source else ""),
        *_facts(subject),
        *_wrapped(f"Limits    {' '.join(limits[1].split())}" if limits else ""),
        *_wrapped(FRAMES),
        *_wrapped(f"Entries   {entries}"),
        *(line for note in notes for line in _wrapped(note)),
        f"Made by   orientation-bench {PROJECT['version']} from the law's one source",
        f"SPDX-FileCopyrightText: {PROJECT['authors'][0]['name']}",
        "SPDX-License-Identifier: Apache-2.0",
    ]
    return "\n".join(lines)


def _attributed(subject: Subject) -> str:
    """Return whose the record is, and its source: "adapted: after A and B"."""
    one = subject.contender if subject.contender is not None else subject.record
    return describe_source(one.attribution, subject.record.source)


def _facts(subject: Subject) -> list[str]:
    """Return the lines of a kind."""
    if subject.contender is None:
        lines = [line for kind, lines in OF_KIND.items() if subject.word.startswith(kind) for line in lines]
        return [*lines, f"Property  {subject.record.property}"] if hasattr(subject.record, "property") else lines
    rows = count_operations(subject.contender)
    counted = next(row for row in rows if (row["branch"], row["stage"]) == ("typical", TOTAL))
    flops, calls = (sum(counted[name] for name in names) for names in (FLOPS, ("sin", "cos", "atan2", "acos")))
    lines = [
        f"{GAINS}near the goal u = kp (rotation vector to the goal) - kv omega",
        *_wrapped(MOTORS if reads_limits(subject.contender.law) else ""),
        f"Property  {subject.record.property}",
        f"Cost      {flops} flops and {calls} calls of sin, cos, atan2, acos for u, in the typical branch",
    ]
    if subject.memory is not None:
        first = ", ".join(map(repr, subject.memory))
        kept, side = "four numbers", ""
        if subject.memory_name.endswith("_wxyz"):
            kept, side = "quaternion of the rotation from R to R_d at the last tick, base frame, of any length", SIDE
        lines += _wrapped(f"Memory    {subject.memory_name}: {kept}; at first ({first}). {RESET} {side}")
    return lines


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, subsequent_indent=" " * 10, break_on_hyphens=False)

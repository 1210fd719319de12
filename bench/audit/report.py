"""Reports on a function, for people and for machines."""

from typing import Any, NamedTuple

import numpy as np

from bench.audit.calls import Call
from bench.audit.convention import Convention
from bench.audit.examined import FAULT, NOTE, PairEvidence
from bench.audit.faults import FoundFault


class Report(NamedTuple):
    """The convention (None if none explains the answers), what was found, and pairs: how many calls were answered."""

    name: str
    pairs: int
    call: Call
    convention: Convention | None
    findings: tuple[FoundFault, ...]

    @property
    def faults(self) -> tuple[str, ...]:
        """Names of the faults that are not allowed."""
        return tuple(one.fault.name for one in self.findings if one.is_fault)

    @property
    def allowed(self) -> tuple[str, ...]:
        """Names of the faults that are allowed."""
        return tuple(one.fault.name for one in self.findings if severity(one) == ALLOWED)

    @property
    def notes(self) -> tuple[str, ...]:
        """Names of the notes."""
        return tuple(one.fault.name for one in self.findings if severity(one) == NOTE)

    def text(self) -> str:
        """Return the whole report."""
        return "\n\n".join((self.head(), *(paragraph(self, one) for one in self.findings))) + "\n"

    def head(self) -> str:
        """Verdict and convention."""
        none = "not looked for" if self.pairs == 0 else "none that is known explains its answers"
        said = self.convention.text() if self.convention else none
        pairs = f" ({self.pairs} pairs)" if self.pairs else ""
        called = "" if self.call == Call(self.call.takes) else f"\nCalled as {self.code()}"
        return f"{self.name}: {self.verdict()}{pairs}{called}\nConvention found: {said}"

    def verdict(self) -> str:
        """Name the faults, those that are allowed, and the notes."""
        parts = [f"FAULTS: {', '.join(self.faults)}" if self.faults else "no fault found"]
        if self.allowed:
            parts.append(f"{len(self.allowed)} allowed: {', '.join(self.allowed)}")
        if self.notes:
            counted = "1 note" if len(self.notes) == 1 else f"{len(self.notes)} notes"
            parts.append(f"{counted}: {', '.join(self.notes)}")
        return ("; " if self.faults else ", ").join(parts)

    def code(self) -> str:
        """Return how the function is called."""
        function = self.name.rpartition(":")[2].rpartition(".")[2] or self.name
        return self.call.code(
            function, *(("R", "R_d") if self.call.takes == "matrix" else ("q", "q_d"))
        )

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "function": self.name,
            "pairs": self.pairs,
            "faults": list(self.faults),
            "takes": self.call.takes,
            "call": self.code(),
            "convention": self.convention._asdict() if self.convention else None,
            "findings": [as_dict(one) for one in self.findings],
        }


ALLOWED = "allowed"


def severity(finding: FoundFault) -> str:
    """Return the word for a finding: fault, allowed or note."""
    if finding.is_allowed and finding.found.severity == FAULT:
        return ALLOWED
    return finding.found.severity


def paragraph(report: Report, finding: FoundFault) -> str:
    """One finding for people."""
    said = as_dict(finding)
    lines = [
        f"{said['severity']} {said['name']}: {said['title']}",
        f"  {said['text']}",
        f"  Effect: {said['effect']}",
        f"  Cure: {said['cure']} (law: {said['law']}; {said['file']})",
    ]
    return "\n".join((*lines, *(f"    {line}" for line in code(report, finding.found.evidence))))


def code(report: Report, evidence: PairEvidence | None) -> list[str]:
    """Return the pair as lines to paste."""
    if evidence is None:
        return []
    now, goal = ("R", "R_d") if evidence.now.shape == (3, 3) else ("q", "q_d")
    right = f"; right is {numbers(evidence.right)}" if len(evidence.right) else ""
    return [
        f"{now} = np.array({numbers(evidence.now)})",
        f"{goal} = np.array({numbers(evidence.goal)})",
        f"{report.code()}  # {numbers(evidence.said)}{right}",
    ]


def numbers(value: np.ndarray | str) -> str:
    """With all digits, without negative zeros."""
    return value if isinstance(value, str) else str((np.asarray(value) + 0.0).tolist())


def as_dict(finding: FoundFault) -> dict[str, Any]:
    """One finding for machines; numbers that are none as words, for JSON has no other."""
    fault, found = finding.fault, finding.found
    evidence = found.evidence
    return {
        "name": fault.name,
        "severity": severity(finding),
        "title": fault.title,
        "text": found.text,
        "effect": found.effect or fault.effect,
        "cure": found.cure or fault.cure,
        "law": fault.law,
        "file": f"bench/audit/faults/{fault.name.replace('-', '_')}.py",
        "evidence": {key: plain(value) for key, value in evidence._asdict().items()}
        if evidence
        else None,
    }


def plain(value: np.ndarray | str) -> Any:
    """Return it as JSON can hold it."""
    if isinstance(value, str):
        return value
    return (
        value.tolist() if np.isfinite(value).all() else [str(one) for one in value.ravel().tolist()]
    )

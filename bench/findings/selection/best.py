"""The best six of the later laws: those that run on arms beside the paper's three (`suites.BEST`).

Of the laws that settle from every start of the run and unwind from none, those that no noise holds at half turns come
first, then the cheaper. Of laws with the same response from rest and the same fate under noise the cheapest alone
counts: others would be the same episodes again.
"""

from __future__ import annotations

import numpy as np

from bench.findings.claims.adequacy import PAPERS
from bench.findings.selection.measured import Measured
from bench.findings.selection.needs import SURE, UNHELD, has_all

SIX = 6
ALIKE = 1e-6
"""Relative difference of efforts, start by start, below which two laws respond alike: rounding leaves 1e-8."""


def best(found: Measured, count: int = SIX) -> list[str]:
    """Their names, the best first."""
    later = [law for law in found.laws if law not in PAPERS and has_all(found, law, SURE)]
    ranked = sorted(later, key=lambda law: (not UNHELD.has(found, law), found.laws.index(law)))
    chosen: list[str] = []
    for law in ranked:
        if not any(_alike(found, law, other) for other in chosen):
            chosen.append(law)
    return chosen[:count]


def _alike(found: Measured, law: str, other: str) -> bool:
    own, others = (found.values["effort"][name] for name in (law, other))
    return UNHELD.has(found, law) == UNHELD.has(found, other) and bool(np.allclose(own, others, rtol=ALIKE, atol=0.0))

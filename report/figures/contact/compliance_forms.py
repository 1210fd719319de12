"""J^-1 S and (S J)^+: where Raibert and Craig's joint servos run away by themselves, over poses of an arm."""

from __future__ import annotations

import functools

import pandas as pd

import tasks
from bench.findings.theory import hybrid_stability as stability
from report.figures.kit import html

ARMS = ("puma560", "ur5e")
POSES, SEED = 400, 0
SELECTIONS = {
    "z": (1, 1, 0, 1, 1, 1),
    "about x and y": (1, 1, 1, 0, 0, 1),
    "z, about x and y": (1, 1, 0, 0, 0, 1),
}
"""What complies -> what is held."""

SERVOS = {"alike": stability.even, "tuned": stability.tuned}
FORMS = {"J⁻¹ S": stability.ORIGINAL, "(S J)⁺": stability.PROJECTED}


@functools.cache
def shares() -> pd.DataFrame:
    """Share of poses at which the arm runs away [%]: a line an arm and selection, a column a form and kind of servo."""
    lines = []
    for name in ARMS:
        at = stability.poses(tasks.arm(name), POSES, SEED)
        for complies, held in SELECTIONS.items():
            line: dict = {"Arm": name, "Complies": complies}
            for form, word in FORMS.items():
                for kind, servos in SERVOS.items():
                    line[f"{form}, servos {kind} [%]"] = 100.0 * stability.unstable_share(at, held, word, servos)
            lines.append(line)
    return pd.DataFrame(lines)


def table() -> html.Markdown:
    """The same, set."""
    found = shares()
    return html.table(found, {name: ".1f" for name in found if str(name).endswith("[%]")})


def facts() -> dict[str, str]:
    """Numbers for the page: poses, and the most that each form loses."""
    found = shares()
    worst = {form: found[[name for name in found if str(name).startswith(form)]].to_numpy().max() for form in FORMS}
    return {
        "forms_poses": html.number(POSES),
        "forms_original": f"{worst['J⁻¹ S']:.0f}",
        "forms_projected_even": html.number(found["(S J)⁺, servos alike [%]"].max()),
    }

"""C21 to C25 on tables as theory has them: word, text or refusal after something is planted there."""

import math

import numpy as np
import pytest
from support.claim_tables import LARGE, YIELDS, Refused, assert_follows, balanced, contact, keep, planted, put
from support.tables import decided

from bench.findings.claims import side_by_side
from bench.findings.claims.contact import FLOORS, PERFORMANCE
from bench.findings.claims.euler_jacobian import EPS
from bench.findings.claims.verdict import Word
from bench.law.control.contact_controller import PAPERS_FORM

HOLDS, CORRECTED, FAILS = Word.HOLDS, Word.CORRECTED, Word.FAILS


@pytest.mark.parametrize(
    ("id", "word"), [("C21", HOLDS), ("C22", FAILS), ("C23", HOLDS), ("C24", HOLDS), ("C25", HOLDS)]
)
def test_claim_is_decided_by_the_theory(id, word):
    assert decided(planted(id), word)


TABLE = "compliance"


def at(*angles, order=None, coordinates=None, **words):
    """Rows of a pose, in an order, of Euler coordinates."""

    def rows(t):
        chosen = (np.degrees(t[["alpha", "beta", "gamma"]]).round(6) == np.array(angles)).all(axis=1)
        return chosen & by(order, coordinates, **words)(t)

    return rows


def by(order=None, coordinates="zyx-euler", **words):
    words |= {"complies": order} if order else {}
    words |= {"representation": coordinates} if coordinates else {}
    return lambda t: np.logical_and.reduce([t["task"] != "", *(t[name] == word for name, word in words.items())])


def without(column, word):
    return lambda t: t[column] != word


def without_general(order):
    return lambda t: (t["complies"] != order) | (t["gamma"] == 0.0)


def as_base(rows):
    """The chosen rows of Euler coordinates with the compliance of hybrid-base at the same poses."""

    def edit(frames):
        t, key, cells = frames[TABLE].copy(), ["arm", "form", "pose"], [*side_by_side.MEASURED, "outcome"]
        base = t[t["controller"] == "hybrid-base"].set_index(key)
        chosen = rows(t)
        t.loc[chosen, cells] = base.loc[t.loc[chosen, key].itertuples(index=False, name=None), cells].to_numpy()
        return {TABLE: t}

    return edit


EULER, ZYZ = "zyx-euler", "zyz-euler"
XY, YZ, LEAKING = "about x and y", "about y and z", at(0, 1, 0, order="about x", coordinates=EULER, form=PAPERS_FORM)
ARMS_SWAPPED = {"puma560": "ur5e", "ur5e": "puma560"}
TURNED = ((1.009, CORRECTED), (1.011, FAILS))


def scaled(factor):
    """An edit that makes one pose no turned axis."""
    rows = at(35, 45, -20, order="about y", coordinates=EULER, arm="ur5e")
    return put(TABLE, rows, **dict.fromkeys(side_by_side.MEASURED, lambda c: factor * c))


OF_COMPLIANCE = [
    *(
        (id, f"By commanded accelerations, {word}:")
        for id, word in (("C22", CORRECTED), ("C23", HOLDS), ("C24", HOLDS))
    ),
    ("C21", FAILS, put(TABLE, at(0, 45, 0, coordinates=EULER), work_residual=1e-10)),
    ("C21", HOLDS, put(TABLE, at(0, 89, 0), work_residual=3400 * EPS)),  # 60 eps / cos(89 deg) = 3400 eps
    ("C21", FAILS, put(TABLE, at(0, 45, 0), work_residual=3400 * EPS)),
    ("C21", CORRECTED, balanced(gain=(["near"], 100.0))),  # forces that are converted and not usable
    ("C22", FAILS, put(TABLE, at(0, 45, 0, order="about z", coordinates=EULER), outcome="saturated")),
    ("C22", HOLDS, as_base(by())),
    ("C23", CORRECTED, lambda frames: {TABLE: frames[TABLE].assign(arm=frames[TABLE]["arm"].map(ARMS_SWAPPED))}),
    ("C23", HOLDS, put(TABLE, at(0, 75, 0, order=XY, coordinates=EULER), c_zx=lambda c: 1.005 * c)),
    ("C23", CORRECTED, put(TABLE, at(0, 75, 0, order=XY, coordinates=EULER), c_zx=lambda c: 1.02 * c)),
    ("C23", CORRECTED, put(TABLE, at(0, 15, 0, order=XY, controller="hybrid-base"), c_zx=0.01 * YIELDS)),
    # what was not measured is not taken for apart
    ("C23", CORRECTED, put(TABLE, at(35, 45, -20, order=YZ, coordinates=EULER), outcome="diverged")),
    ("C23", FAILS, as_base(by())),
    ("C23", CORRECTED, as_base(at(35, 45, -20, order=YZ, coordinates=EULER))),
    ("C24", HOLDS, put(TABLE, LEAKING, c_xx=0.5, c_zx=0.5 * 0.99)),
    ("C24", CORRECTED, put(TABLE, LEAKING, c_xx=0.5, c_zx=0.5 * 1.01)),  # it turns more about z than about x
    ("C24", CORRECTED, put(TABLE, at(0, 5, 0, order="about x", coordinates=EULER), c_xx=0.4 * YIELDS)),
    ("C24", CORRECTED, as_base(at(0, 15, 0, order="about x", coordinates=ZYZ))),
    ("C24", HOLDS, as_base(at(0, 45, 0, order="about x", coordinates=ZYZ))),
    ("C24", FAILS, as_base(by("about x", ZYZ))),
    *(("C22", f"By commanded accelerations, {word}:", scaled(factor)) for factor, word in TURNED),
    # about z always; about y where alpha = 0, 6 of 8 poses; about x at zero alone: on two arms in two forms
    ("C22", "about x at 4 of 32, about y at 24 of 32, about z at 32 of 32"),
    ("C22", "about x at 32 of 32, about y at 24 of 32, about z at 4 of 32"),
    ("C22", "Closer to the pole: 12 saturated", put(TABLE, at(0, 89, 0, coordinates=EULER), outcome="saturated")),
    # alpha = 0: about y and z at all six betas; the others at zero alone: on two arms in two forms
    ("C23", "about x and y at 4 of 24, about y and z at 24 of 24, about z and x at 4 of 24"),
    *((id, Refused("no "), keep(TABLE, lambda t: t["task"] == "")) for id in ("C21", "C22", "C23", "C24")),
    *((id, Refused("hybrid-base"), keep(TABLE, without("controller", "hybrid-base"))) for id in ("C22", "C23", "C24")),
    *(("C22", Refused(one), keep(TABLE, without("complies", one))) for one in ("about x", "about y", "about z")),
    ("C22", Refused("about y"), keep(TABLE, lambda t: t["alpha"] == 0.0)),  # where angle and axis cannot differ
    *(("C23", Refused(two), keep(TABLE, without_general(two))) for two in (XY, YZ, "about z and x")),
    ("C24", Refused("zero rotation"), keep(TABLE, lambda t: ~at(0, 0, 0)(t))),
    ("C24", Refused("zero rotation"), keep(TABLE, at(0, 0, 0))),  # without its neighbourhood
]


def test_c24_looks_near_zero_only():
    assert planted("C24").rows == 4 * 2 * (2 + 1 + 2)  # 0, 1, 5, 15 degrees; two arms; one or two forms


# ----------------------------------------------------------------------------------------------------- C25, contact


def beta(degrees, **words):
    """Rows of Euler coordinates in a frame of the hand that leans."""
    leans = by(**words)
    return lambda t: leans(t) & (t["beta"].round(6) == round(math.radians(degrees), 6))


def complex_at(degrees):
    return lambda t: beta(degrees)(t) & t["complies"].str.contains("about")


def touching(t):
    return t["task"] != "wrench-probe"


def leaning(t):
    return beta(75)(t) & touching(t)


def turned(t):
    return (t["beta"] > 1.0) & t["complies"].str.contains("about") & touching(t)


ALIKE, SAME = contact(is_apart=False), {"alignment_error_rad": 0.1}
"""No pair parts."""

OF_CONTACT = [
    *(("C25", says) for says in ("2 of 2 tasks", "the worse in 4 of 4.", "the worse in 8 of 8;")),
    ("C25", FAILS, ALIKE),
    *(
        ("C25", CORRECTED, put(TABLE, beta(75, **words), **SAME))
        for words in ({"task": "peg-in-hole"}, {"arm": "ur5e"})
    ),
    ("C25", FAILS, put(TABLE, beta(75, form=PAPERS_FORM), **SAME)),
    ("C25", f"By commanded accelerations, {HOLDS}:", put(TABLE, beta(75, form=PAPERS_FORM), **SAME)),
    ("C25", HOLDS, put(TABLE, beta(75, form="inverse"), **SAME)),
    ("C25", f"By commanded accelerations, {CORRECTED}:", put(TABLE, beta(75, form="inverse"), **SAME)),
    # a difference with straight frames is dependence too
    ("C25", HOLDS, put(TABLE, beta(0, task="peg-in-hole", arm="ur5e", form=PAPERS_FORM), outcome="saturated")),
    *(
        ("C25", word, ALIKE, put(TABLE, complex_at(45), **{column: lambda x, factor=factor: factor * x}))
        for column in PERFORMANCE
        for factor, word in ((1.99, FAILS), (2.01, HOLDS), (1 / 2.01, HOLDS))
    ),
    *(  # nothing is compared with almost nothing
        (
            "C25",
            FAILS,
            ALIKE,
            put(TABLE, touching, **{column: 1e-9}),
            put(TABLE, leaning, **{column: 1.9 * FLOORS[unit]}),
        )
        for column, unit in PERFORMANCE.items()
    ),
    ("C25", "worse in 4 of 4.", ALIKE, put(TABLE, complex_at(75), insertion_depth_m=LARGE["insertion_depth_m"] / 3)),
    ("C25", "worse in 0 of 4.", ALIKE, put(TABLE, complex_at(75), insertion_depth_m=LARGE["insertion_depth_m"] * 3)),
    *(("C25", HOLDS, ALIKE, put(TABLE, complex_at(75), **{column: math.nan})) for column in PERFORMANCE),
    *(  # neither has a number
        ("C25", FAILS, ALIKE, put(TABLE, lambda t: t["task"] != "force-on-plane", **{column: math.nan}))
        for column in PERFORMANCE
    ),
    *(
        ("C25", said, ALIKE, put(TABLE, lambda t: turned(t) & (t["controller"] == "hybrid-base"), outcome="diverged"))
        for said in (HOLDS, "worse in 0 of 4.")
    ),
    ("C25", FAILS, ALIKE, put(TABLE, turned, outcome="diverged")),  # both fail alike: nothing to compare
    ("C25", HOLDS, put(TABLE, beta(75, task="force-on-plane"), outcome="saturated")),
    ("C25", "comply 2 of 6 pairs part", put(TABLE, beta(75, task="force-on-plane"), outcome="saturated")),
    ("C25", Refused("no "), keep(TABLE, lambda t: t["task"] == "nothing")),
    ("C25", Refused("with contact"), keep(TABLE, lambda t: ~touching(t))),
    ("C25", Refused("two turns"), keep(TABLE, lambda t: t["task"].isin(["force-on-plane", "wrench-probe"]))),
    ("C25", Refused("peg-in-hole on puma560"), keep(TABLE, lambda t: t["beta"] > 0.0)),
    ("C25", Refused("peg-in-hole on puma560"), keep(TABLE, lambda t: t["beta"] == 0.0)),
    ("C25", Refused("transpose"), keep(TABLE, lambda t: t["form"] == "inverse")),
    ("C25", Refused("projected"), keep(TABLE, lambda t: t["form"] != "projected")),
]


def test_c25_looks_at_every_pair_in_contact():
    assert planted("C25").rows == 54


@pytest.mark.parametrize("case", [*OF_COMPLIANCE, *OF_CONTACT], ids=lambda case: f"{case[0]}-{case[1]}")
def test_verdict_follows_what_is_planted(case):
    assert_follows(*case)


@pytest.mark.parametrize(
    ("cell", "value"), [("exists", False), ("gap", 1e-12), ("gap", math.nan), ("difference_gap", 1e-7)]
)
def test_c21_tells_the_exact_poles_from_other_orientations(cell, value):
    assert_follows("C21", CORRECTED, balanced(**{cell: (["exact"], value)}))
    assert_follows("C21", FAILS, balanced(**{cell: (["near", "exact"], value)}))

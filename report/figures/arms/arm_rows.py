"""Episodes on arms: by which law, Jacobian and inverse each is, in what order they are shown, and how they are called.

A way is `law@jacobian+inverse`, with "standard" for the inverse that is taken if none is named, so that six joints and
seven share a line: it is another one for each.
"""

import functools

import numpy as np
import pandas as pd

import tasks
from bench.experiments.suites import NOMINAL
from bench.experiments.tables.run import Run, shown_run
from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.law.contenders.registry import (
    all_contenders,
    baselines_of_arms,
    contenders,
    contenders_of,
)
from bench.law.kinds import OnCoordinates
from report.figures.kit import families

STANDARD = "standard"
WORDS = ("arm", "variation", "regulator", "representation", "jacobian", "inverse", "start_set", "start_id", "outcome")
ON_MATRIX, ON_ANGLES = "rotation-matrix@geometric", "feedback-linearized/zyx-euler@analytic"
"""The law on R by (2.2), and the paper's (3.7)."""
COMPARED = (ON_MATRIX, "feedback-linearized/zyx-euler@geometric", ON_ANGLES)
"""The law on R, and that of (3.7) by the geometric Jacobian and by its own."""
PAPERS_JACOBIANS = ("geometric", "analytic")


def name_arm(arm: str) -> str:
    """Return what an arm is called."""
    return tasks.arm(arm).title if arm in tasks.arm_names() else arm


@functools.cache
def every(run: Run) -> pd.DataFrame:
    """Return the episodes of the run on arms with their law, way and controller."""
    return named(run.rows("episodes", task="arm-regulation", engine="native"))


def episodes(run: Run, variation: str = NOMINAL) -> pd.DataFrame:
    """Return the episodes of arms as they are, or of a variation."""
    return every(run)[every(run)["variation"] == variation]


def named(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the frame with plain words, and columns law, controller (law@jacobian) and way (law@jacobian+inverse)."""
    frame = frame.assign(**{word: frame[word].astype(str) for word in WORDS if word in frame})
    slash = np.where(frame["representation"] == "", "", "/")
    law = frame["regulator"] + slash + frame["representation"]
    parts = zip(frame["arm"], law, frame["jacobian"], frame["inverse"], strict=True)
    inverse = [STANDARD if one[3] == standard(*one[:3]) else one[3] for one in parts]
    controller = law + "@" + frame["jacobian"]
    return frame.assign(law=law, controller=controller, way=controller + "+" + pd.Series(inverse, frame.index, str))


@functools.cache
def standard(arm: str, law: str, jacobian: str) -> str:
    """Return the inverse that this law and Jacobian take on that arm if none is named; empty if nothing fits."""
    if law in baselines_of_arms() and baselines_of_arms()[law].inverse:
        return baselines_of_arms()[law].way[1]
    fitting = combinations.on((f"{law}@{jacobian}+{STANDARD}",), laws_by_name(), tasks.arm(arm).joints)
    return fitting[0].way[1] if fitting else ""


@functools.cache
def laws_by_name() -> dict[str, Contender]:
    """Every law in its coordinates by name, the user's own of the run among them."""
    own = [one for law in shown_run().user_laws() for one in contenders_of(law)]
    return {one.name: one for one in (*all_contenders(), *own)} | baselines_of_arms()


def with_standard(rows: pd.DataFrame) -> pd.DataFrame:
    """Laws by the paper's two Jacobians and the standard inverse."""
    is_law = ~rows["regulator"].isin(baselines_of_arms())
    return rows[is_law & rows["way"].str.endswith(f"+{STANDARD}") & rows["jacobian"].isin(PAPERS_JACOBIANS)]


def title(controller: str) -> str:
    """How a controller is called in a figure: its equation, and the law or the coordinates."""
    law, _, jacobian = controller.partition("@")
    if law in baselines_of_arms():
        return baselines_of_arms()[law].regulator.title
    regulator, _, coordinates = law.partition("/")
    where = contenders("representations")[coordinates].title.removesuffix(" angles") if coordinates else ""
    if contenders("jacobians")[jacobian].takes != "angular-acceleration":
        return f"(3.7) {where}"
    one = contenders("regulators").get(regulator)
    name = one.title.partition(" (")[0] if one else regulator
    if one and one.is_beyond_the_paper:
        word = families.word(law)
        name = word[:1].upper() + word[1:]
    function = one.law if one else None
    has_both = isinstance(function, OnCoordinates) and function.coordinate_law_in is not None
    return f"(2.2) {name}, {where}" if where and has_both else f"(2.2) {name}"

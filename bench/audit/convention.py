"""What a function means: its input, the frame and direction of its three numbers, its form, its slope at the goal.

Swapped arguments are no case of their own: log(R R_d^T) = -log(R_d R^T), so that they only reverse the direction.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bench.audit.pairs import Pairs, Place
from bench.base.errors import BadNumber, UnknownWord


class ErrorForm(NamedTuple):
    """A form by its closed form: size(theta), along k."""

    title: str
    size: Callable


FORMS = {
    "rotation-vector": ErrorForm("θ", size=lambda theta: theta),
    "sine-of-half": ErrorForm("2 sin(θ/2)", size=lambda theta: 2.0 * np.sin(theta / 2.0)),
    "sine": ErrorForm("sin θ", size=np.sin),
    "mrp": ErrorForm("4 tan(θ/4)", size=lambda theta: 4.0 * np.tan(theta / 4.0)),
    "gibbs": ErrorForm("2 tan(θ/2)", size=lambda theta: 2.0 * np.tan(theta / 2.0)),
}
"""What three numbers can say of a rotation by theta about k, each theta k near the identity.

Only sin(theta) k is zero at 180°, only 2 tan(theta/2) k is infinite there, and only Euler angles have poles. A function
is judged by its own form first, so that what it means is distinguished from what it gets wrong.
"""

TAKES = ("matrix", "wxyz", "xyzw")
"""3 x 3 matrices, or quaternions with the scalar first or last."""
FRAMES = ("base", "body")
"""Frames of the three numbers. The body frames of R and of R_d are one for them: R_d^T k = R^T k."""
SIGNS = ("to-goal", "from-goal")
"""Directions: along the rotation from R to R_d, as R_d - R, or back, as R - R_d and with swapped arguments."""


class Stated(NamedTuple):
    """The arguments of `audit`."""

    takes: str | None = None
    frame: str | None = None
    sign: str | None = None
    stiffness: float = 1.0
    allow: tuple[str, ...] = ()

    def check(self, faults: list[str]) -> None:
        """Refuse what is in no list."""
        words = (("input", self.takes, TAKES), ("frame", self.frame, FRAMES), ("sign", self.sign, SIGNS))
        for kind, given, known in (*words, *(("fault", one, faults) for one in self.allow)):
            if given is not None and given not in known:
                raise UnknownWord(kind, given, list(known))
        if not 0.0 < self.stiffness < float("inf"):
            raise BadNumber(f"stiffness {self.stiffness} is not a positive number (1 where the gains are all of it)")


ALONG_RAD = 0.1
"""An answer nearer than this to the axis, 6 degrees, lies along it: of two random directions 0.5 % are so near."""
ENOUGH = 0.7
"""Share of pairs that a convention must explain: a fault on a part of them must not hide what is meant."""

FEWEST = 0.2
"""Share of answers the right way that is enough to tell a form by."""

FIT: dict[Place, float] = {"wide": 1e-5, "close": 1e-6, "fine": 1e-9}
"""Places where forms are distinguished, and how well the right one fits there, of its size.

Two forms differ by a twenty-fourth of the square at least, 1e-4 at 0.05 rad and 1e-6 at 0.005 rad; forms of no name may
differ from one by the fourth power, 1e-8 and less. Single precision has 6e-8, so that only wide pairs decide.
"""


NEAREST_RAD, NEARER_RAD, EVEN = (1e-4, 2e-3), (1e-5, 1e-4), 1e-5
"""Angles at which a form of no name, clipped as short as 0.002 rad, has its slope, if it is one there: to the square
of the angle, 4e-6, and to double precision. Single precision, 6e-4 at 1e-4 rad, and dead bands have none. A sine of
degrees has it nearer."""


class Convention(NamedTuple):
    """takes, frame and sign as in `stated`; form: a word of FORMS, or "" for a size of its own; slope: |e|/theta."""

    takes: str
    frame: str
    sign: str
    form: str
    slope: float

    def text(self) -> str:
        """For people."""
        given = "matrices (R, R_d)" if self.takes == "matrix" else f"quaternions (q, q_d), {self.takes}"
        way = "from R to R_d" if self.sign == "to-goal" else "from R_d to R"
        form = f"{FORMS[self.form].title} k" if self.form else "along k, with a size of its own"
        said = f"takes {given}; {self.frame} frame; points {way}; {form}; slope at the goal {self.slope:.6g}"
        if (self.takes, self.frame, self.sign) != ("matrix", "body", "from-goal"):
            return said
        return f"{said}. Of matrices stored by columns the same function is in base and points to R_d"


def directions(pairs: Pairs, frame: str) -> np.ndarray:
    """Return the axis k (n x 3) in base or in body frame."""
    return pairs.axis if frame == "base" else np.einsum("nij,ni->nj", pairs.R, pairs.axis)


def apart(e: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Angle (n) between answers and an axis [rad]; NaN where an answer has no direction."""
    along = (e * axis).sum(axis=1)
    across = np.linalg.norm(np.cross(axis, e), axis=1)
    return np.where((along == 0.0) & (across == 0.0), np.nan, np.arctan2(across, along))


def find(takes: str, pairs: Pairs, e: np.ndarray) -> tuple[float, Convention | None]:
    """Return the best convention for answers e (n x 3), and the share of pairs whose direction it explains."""
    best: tuple[float, str, int] = (0.0, "", 0)
    for frame in FRAMES:
        angle = apart(e, directions(pairs, frame))
        for place in FIT:
            here = angle[pairs.at(place)]
            share = float(np.mean((here < ALONG_RAD) | (here > np.pi - ALONG_RAD)))
            if share > best[0] + 1e-9:
                best = (share, frame, way(here, np.linalg.norm(e[pairs.at(place)], axis=1)))
    share, frame, sign = best
    if share < ENOUGH:
        return share, None
    size = sign * (e * directions(pairs, frame)).sum(axis=1)
    form, slope = form_of(pairs, size)
    return share, Convention(takes, frame, "to-goal" if sign > 0 else "from-goal", form, slope)


def way(angle: np.ndarray, size: np.ndarray) -> int:
    """Return 1 if the shorter half of the answers points along the axis, -1 if against it; others may deviate."""
    short = size <= np.nanmedian(size)
    return 1 if np.nanmedian(angle[short]) < np.pi / 2.0 else -1


def form_of(pairs: Pairs, size: np.ndarray) -> tuple[str, float]:
    """Return the form that the sizes along the axis have, where they decide one, and the slope at the goal."""
    for place, tolerance in FIT.items():
        here = pairs.at(place) & (size > 0.0)
        if here.sum() < FEWEST * pairs.at(place).sum():
            continue
        for form, one in FORMS.items():
            ratio = size[here] / one.size(pairs.angle[here])
            slope = float(np.nanmedian(ratio))
            if slope > 0.0 and np.mean(np.abs(ratio / slope - 1.0) < tolerance) >= ENOUGH:
                return form, slope
    for angles in (NEAREST_RAD, NEARER_RAD):
        nearest = is_nearest(pairs, angles)
        ratio = size[nearest] / pairs.angle[nearest]
        if len(ratio) and np.ptp(ratio) <= EVEN * ratio.min():
            return "", float(np.median(ratio))
    fine = pairs.at("fine")
    there = fine & (size > 0.0)
    if there.sum() < FEWEST * fine.sum():
        return "", 0.0
    line = np.polyfit(pairs.angle[there] ** 2, size[there] / pairs.angle[there], 1)  # in the square of the angle
    return "", float(line[1])


def is_nearest(pairs: Pairs, angles: tuple[float, float] = NEAREST_RAD) -> np.ndarray:
    """Return the pairs (n) near the goal with an angle between two, as a mask."""
    return pairs.at("near-identity") & (pairs.angle >= angles[0]) & (pairs.angle <= angles[1])

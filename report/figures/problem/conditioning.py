"""How badly each set of coordinates maps omega to Edot, as the body turns about one axis: where B^-1 is lost.

Representations of the registry are mapped by their own `angular_velocity`; of four numbers only the three that move
the body count. The rotation vector goes by its closed form, which follows it past 180°, where logarithms jump.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bench.law.contender import Representation
from bench.law.contenders.registry import known_representations
from bench.law.so3 import from_quaternion
from report.figures.kit import style
from report.figures.kit.inline import responsive_picture

CEILING = 1e4
STEP_DEG = 0.25
COLOURS = ("#009e73", "#d55e00", "#0072b2", "#cc79a7", "#e69f00", "#56b4e9", "#a39400")
LINES = (style.SOLID, style.DASHED, style.DASH_DOT, style.DOTTED)


def condition(columns) -> float:
    """Largest over smallest singular value; infinite for a singular map."""
    singular = np.linalg.svd(np.array(columns), compute_uv=False)
    return float(singular[0] / singular[-1]) if singular[-1] > 0.0 else math.inf


def of_representation(one: Representation) -> Callable[[float], float]:
    """Condition number of B of a registered representation, after a turn by theta about y."""

    units = np.eye(len(one.symbols)).tolist()

    def at(theta):
        chart = one.chart(from_quaternion((math.cos(theta / 2), 0.0, math.sin(theta / 2), 0.0)))
        return condition([one.angular_velocity(chart, rate) for rate in units])

    return at


def rotation_vector(theta: float) -> float:
    """omega = J_l(phi) phidot; J_l has the singular values 1, and sin(theta/2) / (theta/2) twice."""
    half = theta / 2.0
    small = abs(math.sin(half) / half) if half else 1.0
    return 1.0 / small if small > 0.0 else math.inf


def curves() -> dict[str, Callable[[float], float]]:
    """Title -> condition number against the angle."""
    own = {"rotation-vector": rotation_vector}
    return {one.title: own.get(name) or of_representation(one) for name, one in known_representations().items()}


@responsive_picture
def conditioning(*, narrow=False):
    """Condition number of the map from omega to Edot while the body turns once about y."""
    figure, axes = style.panels(height=3.3 if not narrow else 3.7, narrow=narrow)
    degrees = np.arange(0.0, 360.0 + STEP_DEG, STEP_DEG)
    words = []
    for place, (title, of) in enumerate(curves().items()):
        values = np.array([of(math.radians(angle)) for angle in degrees])
        axes.plot(
            degrees,
            np.minimum(values, 2 * CEILING),
            color=COLOURS[place % len(COLOURS)],
            linestyle=LINES[place % len(LINES)],
            label=title,
        )
        words.append(f"{title} beyond {CEILING:.0e} at {peaks(degrees, values)}")
    axes.set(yscale="log", ylim=(0.8, CEILING), xlim=(0, 360))
    axes.set_xticks(range(0, 361, 90), [f"{angle}°" for angle in range(0, 361, 90)])
    axes.set(xlabel="Rotation about $y$", ylabel=r"Condition number of $\omega \mapsto \dot E$")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=1 if narrow else 3)
    return figure, "Condition number against the angle of a rotation about y, logarithmic: " + "; ".join(words) + "."


def peaks(degrees: np.ndarray, values: np.ndarray) -> str:
    """The angles at which the curve leaves the figure, neighbours once."""
    out = degrees[values > CEILING]
    kept = [angle for place, angle in enumerate(out) if place == 0 or angle - out[place - 1] > 2 * STEP_DEG]
    return ", ".join(f"{angle:.0f}°" for angle in kept) or "no angle"

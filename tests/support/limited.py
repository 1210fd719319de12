"""Laws that read the limits of their motors: one that only shows what it was told, and the field's cascade."""

from pathlib import Path

SHOWS = '''"""A law whose command shows the limits that it reads."""

from bench.law import Law, kernel


@kernel
def law(R, omega, goal, gains):
    """u = (bound/2 or 1 if there is none, delay, 0)."""
    told = 1.0
    if gains.bound < 1e9:
        told = 0.5 * gains.bound
    return (told, gains.delay, 0.0)


REGULATOR = Law(name="shows", title="Shows", source="", formula="u", law=law)
'''

CASCADE = '''"""A cascade: the rate towards the goal is the greatest one that the bound can still brake."""

from bench.law import Law, dot, kernel, sqrt, turn_quaternion
from bench.law.scalar import atan2

SHARE = 0.7


@kernel
def brakeable_rate(theta, p, bound):
    """Return p theta near the goal, and beyond sqrt(2 a (theta - a/(2 p^2))), a = SHARE bound."""
    rate = p * theta
    a = SHARE * bound
    knee = a / (p * p)
    if theta > knee:
        rate = sqrt(2.0 * a * (theta - 0.5 * knee))
    return rate


@kernel
def law(R, omega, goal, gains):
    """u = Kv (rate k - omega), k the axis of the turn from R to R_d."""
    w, v, _ = turn_quaternion(R, goal.R)
    size = sqrt(dot(v, v))
    along = 0.0
    if size > 1e-9:
        along = gains.kv * brakeable_rate(2.0 * atan2(size, w), gains.kp / gains.kv, gains.bound) / size
    return (
        along * v[0] - gains.kv * omega[0],
        along * v[1] - gains.kv * omega[1],
        along * v[2] - gains.kv * omega[2],
    )


REGULATOR = Law(name="brakeable", title="Brakeable rate", source="", formula="u", law=law)
'''


def write_law(folder: Path, text: str) -> Path:
    """Write a law's file."""
    path = folder / "limited.py"
    path.write_text(text)
    return path

"""The law dialect: all that a law may call, besides `so3` and `linalg`.

A law is a pure function of numbers and tuples, written once and used four times: called with floats it is the
definition; compiled it is fast; called with counting scalars it yields its cost; printed it is the page. What such
a function may contain:

    + - * /      < <= > >=      if on a comparison      tuples      for over a fixed range
    sqrt sin cos atan2 acos copysign      functions marked @kernel

and what it may not: `**`, `==`, `abs`, numpy, exceptions, globals other than kernels and constants. `x == y` on a
counting scalar raises, so that no comparison goes uncounted.

Every function here keeps the type it is given and follows IEEE 754 instead of raising: sqrt(-1) is NaN, as it is in
compiled code. Division keeps to that rule when the numbers are numpy.float64, which is what every engine passes; a
Python float would raise ZeroDivisionError.
"""

import math

KERNELS: list = []
"""Every function marked `@kernel`, in the order of definition; the compiled engines register them with numba."""


def kernel(function):
    """Mark a function as code of a law that can be translated. The mark does not compile the function."""
    KERNELS.append(function)
    return function


def _ieee(function, *numbers):
    """libm's answer in the numbers' own type; NaN outside the domain, where `math` raises."""
    try:
        answer = function(*numbers)
    except ValueError:
        answer = math.nan
    return type(numbers[0] + numbers[-1])(answer)


def sqrt(x):
    """Square root; NaN below zero."""
    return x.sqrt() if hasattr(x, "tally") else _ieee(math.sqrt, x)


def sin(x):
    """Sine of an angle in radians; NaN at infinity."""
    return x.sin() if hasattr(x, "tally") else _ieee(math.sin, x)


def cos(x):
    """Cosine of an angle in radians; NaN at infinity."""
    return x.cos() if hasattr(x, "tally") else _ieee(math.cos, x)


def acos(x):
    """Arc cosine in [0, pi]; NaN outside [-1, 1]."""
    return x.acos() if hasattr(x, "tally") else _ieee(math.acos, x)


def atan2(y, x):
    """Angle of the point (x, y) in [-pi, pi]; atan2(0, 0) is 0."""
    if hasattr(y, "tally"):
        return y.atan2(x)
    if hasattr(x, "tally"):
        return x.ratan2(y)
    return _ieee(math.atan2, y, x)


def copysign(magnitude, sign):
    """Return the magnitude with the sign bit of the second number, signed zero included."""
    if hasattr(magnitude, "tally"):
        return magnitude.copysign(sign)
    if hasattr(sign, "tally"):
        return sign.rcopysign(magnitude)
    return _ieee(math.copysign, magnitude, sign)


PRIMITIVES = (sqrt, sin, cos, acos, atan2, copysign)
"""In compiled code each becomes the function of the same name in `math`, which is libm's."""

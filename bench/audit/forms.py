"""What three numbers can say of a rotation by theta about k, each theta k near the identity.

The rotation vector is the error itself. The others are errors of their own right, and laws have been built on each;
only `sin(theta) k` is zero at 180°, only 2 tan(theta/2) k is infinite there, and only Euler angles have poles. A
function is first judged by its own form, so that what it means is distinguished from what it gets wrong.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Form(NamedTuple):
    """A form by its closed form: size(theta), along k."""

    title: str
    size: Callable


FORMS = {
    "rotation-vector": Form("θ", size=lambda theta: theta),
    "sine-of-half": Form("2 sin(θ/2)", size=lambda theta: 2.0 * np.sin(theta / 2.0)),
    "sine": Form("sin θ", size=np.sin),
    "mrp": Form("4 tan(θ/4)", size=lambda theta: 4.0 * np.tan(theta / 4.0)),
    "gibbs": Form("2 tan(θ/2)", size=lambda theta: 2.0 * np.tan(theta / 2.0)),
}

"""Annotations of arrays: how many indices they have. `typed.type_of` makes a compiler's types of them."""

from typing import TYPE_CHECKING, Annotated, TypeAlias

import numpy as np

Vector = Annotated[np.ndarray, 1]
Matrix = Annotated[np.ndarray, 2]
Cube = Annotated[np.ndarray, 3]
Integers = Annotated[np.ndarray, "integers"]

if TYPE_CHECKING:
    Three: TypeAlias = tuple[float, ...]
    Four: TypeAlias = tuple[float, ...]
    Six: TypeAlias = tuple[float, ...]
    Seven: TypeAlias = tuple[float, ...]
else:
    Three, Four, Six, Seven = (tuple[(float,) * length] for length in (3, 4, 6, 7))

"""What an export to Python runs on; its text goes into every exported file as it is.

Whoever asks a law for many states at once has a lane for each, and a branch becomes a mask: both of its sides are
computed, and each lane keeps its own. Where a lane does not take a side, what would be outside the domain of a root, a
quotient or an arc there is replaced first, so that neither a warning nor the gradient of a lane comes of a side that it
does not take. What a lane takes keeps every bit.
"""

import importlib
from collections.abc import Callable
from typing import Any, NamedTuple


class Lanes(NamedTuple):
    """A call. xp: its arrays' namespace; like: an array of its lanes; live: the lanes on this side, None if all are."""

    xp: Any
    like: Any
    live: Any = None

    def array(self, x: Any) -> Any:
        """Python's numbers as arrays, all else as it is."""
        return self.xp.full_like(self.like, x) if type(x) in (int, float) else x

    def safe(self, x: Any, instead: float = 1.0) -> Any:
        """x in live lanes, elsewhere what does no harm."""
        x = self.array(x)
        return x if self.live is None else self.xp.where(self.live, x, instead)

    def sqrt(self, x: Any) -> Any:
        """Square root; NaN below zero."""
        return self.xp.sqrt(self.safe(x))

    def sin(self, x: Any) -> Any:
        """Of radians."""
        return self.xp.sin(self.array(x))

    def cos(self, x: Any) -> Any:
        """Of radians."""
        return self.xp.cos(self.array(x))

    def acos(self, x: Any) -> Any:
        """In [0, pi]; its slope is infinite at 1, so that 0 is what does no harm."""
        return self.xp.acos(self.safe(x, 0.0))

    def atan2(self, y: Any, x: Any) -> Any:
        """Angle of the point (x, y)."""
        return self.xp.atan2(self.array(y), self.safe(x))

    def copysign(self, magnitude: Any, sign: Any) -> Any:
        """That magnitude with that sign."""
        return self.xp.copysign(self.array(magnitude), self.array(sign))

    def either(self, mask: Any, then: Callable, otherwise: Callable) -> Any:
        """What `then` returns where the mask is true, elsewhere what the other returns."""
        if isinstance(mask, bool):
            return (then if mask else otherwise)(self)
        here, there = (mask, ~mask) if self.live is None else (self.live & mask, self.live & ~mask)
        return self.merged(mask, then(self._replace(live=here)), otherwise(self._replace(live=there)))

    def merged(self, mask: Any, one: Any, other: Any) -> Any:
        """Lane by lane, through tuples."""
        if one is other:
            return one
        if isinstance(one, tuple):
            parts = [self.merged(mask, *pair) for pair in zip(one, other, strict=True)]
            return type(one)(*parts) if hasattr(one, "_fields") else tuple(parts)
        return self.xp.where(mask, self.array(one), self.array(other))

    def number(self, x: Any) -> Any:
        """A result, one for every lane."""
        x, shape = self.array(x), self.like.shape
        return x if x.shape == shape else self.xp.broadcast_to(x, shape)

    def vector(self, v: tuple) -> Any:
        """Numbers as the last axis of an array."""
        return self.xp.stack([self.number(x) for x in v], axis=-1)

    def matrix(self, R: tuple) -> Any:
        """Columns as the last two axes of an array."""
        return self.xp.stack([self.vector(column) for column in R], axis=-1)


def opened(**given: tuple) -> list:
    """The lanes of a call, then its arguments as arrays of numbers that are not whole.

    Each is given by its name as a value and its last axes. Lists become arrays like the others; a number of Python's
    where no axes are asked stays one.
    """
    spaces = {name: namespace(value) for name, (value, *_) in given.items()}
    known = [one for one in spaces.values() if one is not None]
    xp = next((one for one in known if one.__name__ != "numpy"), None) or importlib.import_module("numpy")
    first = next((1.0 * value for name, (value, *_) in given.items() if spaces[name] is xp), None)
    values, shapes, like = [], [], None
    for name, (value, *axes) in given.items():
        if isinstance(value, (int, float)) and not axes:
            values.append(float(value))
            continue
        if spaces[name] is not xp:
            make = getattr(first, "new_tensor", xp.asarray)  # torch's own knows the device
            value = make(value, dtype=None if first is None else first.dtype)
        value, size = 1.0 * value, len(value.shape) - len(axes)
        if size < 0 or list(value.shape[size:]) != axes:
            allowed = ", ".join(map(str, ("...", *axes)))
            raise ValueError(f"{name} has the shape {tuple(value.shape)}; allowed: ({allowed})")
        values.append(value)
        shapes.append(tuple(value.shape[:size]))
        like = value[(..., *(0 for _ in axes))] if like is None else like
    return [Lanes(xp, xp.broadcast_to(like, broadcast(shapes))), *values]


def namespace(x: Any) -> Any:
    """Of an array; None of what is none. torch's tensors do not say theirs."""
    if isinstance(x, (int, float)):
        return None
    if hasattr(x, "__array_namespace__"):
        return x.__array_namespace__()
    is_tensor = any(one.__module__.partition(".")[0] == "torch" for one in type(x).__mro__)
    return importlib.import_module("torch") if is_tensor else None


def broadcast(shapes: list) -> tuple:
    """The shape that all of them have together; sizes that do not fit are found by whoever uses it."""
    longest = max(map(len, shapes))
    padded = [(1,) * (longest - len(shape)) + shape for shape in shapes]
    return tuple(next((size for size in sizes if size != 1), 1) for sizes in zip(*padded, strict=True))


def numbers(v: Any) -> tuple:
    """Of the last axis."""
    return tuple(v[..., i] for i in range(v.shape[-1]))


def columns(R: Any) -> tuple:
    """Of a matrix."""
    return tuple(tuple(R[..., i, j] for i in range(3)) for j in range(3))


def by_rows(A: Any) -> tuple:
    """The nine numbers of a matrix."""
    return tuple(A[..., i, j] for i in range(3) for j in range(3))

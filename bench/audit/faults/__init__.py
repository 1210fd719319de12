"""Faults of an orientation error: one file each, with a constant FAULT."""

import functools
import importlib
import pkgutil

from bench.audit.fault import Fault


@functools.cache
def every_fault() -> tuple[Fault, ...]:
    """Return all of them, by name."""
    names = sorted(one.name for one in pkgutil.iter_modules(__path__))
    files = (importlib.import_module(f"{__name__}.{name}") for name in names)
    return tuple(
        one.FAULT._replace(name=name.replace("_", "-"), find=one.find) for name, one in zip(names, files, strict=True)
    )

"""Faults of an orientation error: one file each, with a constant FAULT."""

import functools
import importlib
import pkgutil

from bench.audit.fault import Fault


@functools.cache
def every_fault() -> tuple[Fault, ...]:
    """Return all of them, by name."""
    found = (importlib.import_module(f"{__name__}.{one.name}") for one in pkgutil.iter_modules(__path__))
    return tuple(sorted((one.FAULT for one in found), key=lambda fault: fault.name))

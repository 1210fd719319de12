"""Faults of an orientation error, one file each: its words are the docstring, and `find(examined)` looks for it.

The first sentence is the title; `effect`, `cure`, `law` and `unless` are fields of `Fault`, names with commas between.
`find_known` in its place looks only at functions whose convention is known. A fault that ends the asking (`Lost`) has
neither.
"""

import functools
import importlib
import inspect
import pkgutil
import re

from bench.audit.fault import Fault


@functools.cache
def every_fault() -> tuple[Fault, ...]:
    """Return all of them, by name."""
    return tuple(read_fault(name) for name in sorted(one.name for one in pkgutil.iter_modules(__path__)))


def read_fault(name: str) -> Fault:
    """Return the fault of a file."""
    module = importlib.import_module(f"{__name__}.{name}")
    title, _, text = (inspect.getdoc(module) or "").partition(".\n\n")
    words = {key: " ".join(said.split()) for key, said in re.findall(r"^(\w+): (.*(?:\n .*)*)", text, re.MULTILINE)}
    unless = tuple(filter(None, words.pop("unless", "").split(", ")))
    known = getattr(module, "find_known", lambda examined: None)
    find = getattr(module, "find", lambda examined: known(examined) if examined.convention else None)
    return Fault(title, **words, unless=unless, name=name.replace("_", "-"), find=find)

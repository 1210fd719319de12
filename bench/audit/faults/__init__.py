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
from collections.abc import Callable
from typing import NamedTuple

from bench.audit.examined import FAULT, Symptom


class Fault(NamedTuple):
    """One kind of fault: what the docstring of its file says of it, and its `find`.

    Args:
        law: the name of a regulator that has it right.
        unless: names of faults that explain this one: with any of them it is not reported.
        name: of the file, with dashes: word in reports and on the command line, anchor on the page.
    """

    title: str
    effect: str
    cure: str
    law: str = "rotation-vector"
    unless: tuple[str, ...] = ()
    name: str = ""
    find: Callable = print


class FoundFault(NamedTuple):
    """A fault of a function; `is_allowed`: its author says that it is intended."""

    fault: Fault
    found: Symptom
    is_allowed: bool = False

    @property
    def is_fault(self) -> bool:
        """Tell whether it makes the audit fail."""
        return self.found.severity == FAULT and not self.is_allowed


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

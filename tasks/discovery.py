"""Find the one named constant of every module in a folder: no registry to edit, no import with side effects."""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections.abc import Mapping
from types import ModuleType
from typing import Any, TypeVar

from tasks.errors import UnknownName

Found = TypeVar("Found")


@functools.cache
def constants(folder: ModuleType, constant: str) -> dict[str, Any]:
    """Return {file name with dashes: its constant} for every module that has one, sorted; a folder is read once."""
    found = {}
    for module_info in sorted(pkgutil.iter_modules(folder.__path__), key=lambda info: info.name):
        module = importlib.import_module(f"{folder.__name__}.{module_info.name}")
        if hasattr(module, constant):
            found[module_info.name.replace("_", "-")] = getattr(module, constant)
    return found


def pick(kind: str, name: str, known: Mapping[str, Found], where: str) -> Found:
    """Return known[name], or raise an UnknownName that says what there is."""
    if name not in known:
        listed = ", ".join(sorted(known))
        raise UnknownName(f"{kind} '{name}' is not in {where}; known: {listed} (use one, or add a file there)")
    return known[name]

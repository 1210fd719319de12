"""Modules that take long to import, by the names that everybody uses: a plan, a list or a help text waits for none."""

import importlib
from typing import TYPE_CHECKING, Any

__all__ = ["pd"]


class Lazy:
    """A module that is imported when it is first asked for something."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __getattr__(self, word: str) -> Any:
        return getattr(importlib.import_module(self.name), word)


if TYPE_CHECKING:
    import pandas as pd
else:
    pd = Lazy("pandas")

"""pandas and SciPy's Rotation, imported when a function first uses them.

Either takes a quarter of a second. `bench --help`, `bench list` and `bench run --dry-run` import modules that need them
later: these import `pd` from here; elsewhere `import pandas as pd` is right.
"""

import importlib
from typing import TYPE_CHECKING, Any

__all__ = ["ScipyRotation", "pd"]


class DeferredImport:
    """Stand for a module, or for a class of a module; the first attribute that is read imports it."""

    def __init__(self, module: str, name: str = "") -> None:
        self.module, self.name = module, name

    def __getattr__(self, word: str) -> Any:
        module = importlib.import_module(self.module)
        return getattr(getattr(module, self.name) if self.name else module, word)


if TYPE_CHECKING:
    import pandas as pd
    from scipy.spatial.transform import Rotation as ScipyRotation
else:
    pd, ScipyRotation = (
        DeferredImport("pandas"),
        DeferredImport("scipy.spatial.transform", "Rotation"),
    )

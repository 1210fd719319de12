"""What takes long to import, by the names that everybody uses: a plan, a list or a help text waits for none of it."""

import importlib
from typing import TYPE_CHECKING, Any

__all__ = ["Turn", "pd"]


class Lazy:
    """A module, or a class of it, that is imported when it is first asked for something."""

    def __init__(self, module: str, name: str = "") -> None:
        self.module, self.name = module, name

    def __getattr__(self, word: str) -> Any:
        module = importlib.import_module(self.module)
        return getattr(getattr(module, self.name) if self.name else module, word)


if TYPE_CHECKING:
    import pandas as pd
    from scipy.spatial.transform import Rotation as Turn
else:
    pd, Turn = Lazy("pandas"), Lazy("scipy.spatial.transform", "Rotation")

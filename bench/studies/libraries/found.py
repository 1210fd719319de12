"""Which libraries can be asked: every file in bench/studies/libraries/asked whose library is installed here."""

import functools
import importlib
import importlib.metadata
import pkgutil
from typing import NamedTuple

from bench.studies.libraries import asked
from bench.studies.libraries.library import Function, Library


class Found(NamedTuple):
    """The libraries that import, and of the others the name and why not."""

    libraries: tuple[Library, ...]
    missing: dict[str, str]

    def function(self, library: str, name: str) -> Function:
        """One function by the names it has in the table."""
        (one,) = (one for one in self.libraries if one.name == library)
        (found,) = (function for function in one.functions if function.name == name)
        return found


@functools.cache
def find() -> Found:
    """Import what is there."""
    libraries, missing = [], {}
    for module_info in pkgutil.iter_modules(asked.__path__):
        try:
            module = importlib.import_module(f"{asked.__name__}.{module_info.name}")
        except ImportError as error:
            missing[module_info.name] = str(error)
        else:
            libraries.append(module.LIBRARY)
    return Found(tuple(libraries), missing)


def version_of(library: Library) -> str:
    """Of its package, as installed."""
    return importlib.metadata.version(library.package)

"""Which libraries can be asked: every file in bench/studies/libraries/asked whose library is installed here."""

import functools
import importlib
import importlib.metadata
import pkgutil
import subprocess
from typing import NamedTuple

from bench.base.errors import UnknownWord
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
def find(*names: str) -> Found:
    """Import what is there, or of it the files of these names alone.

    Errors:
        UnknownWord: no file of asked/ has that name.
    """
    libraries: list[Library] = []
    missing, files = {}, [one.name for one in pkgutil.iter_modules(asked.__path__)]
    for name in names:
        if name not in files:
            raise UnknownWord("library", name, files)
    for name in names or files:
        try:
            module = importlib.import_module(f"{asked.__name__}.{name}")
        except ImportError as error:  # not installed, or no compiler
            missing[name] = str(error)
        else:
            libraries += module.LIBRARIES if hasattr(module, "LIBRARIES") else (module.LIBRARY,)
    return Found(tuple(libraries), missing)


def version_of(library: Library) -> str:
    """Return the installed version; of restated code, the commit that was read, which its `package` ends with."""
    if library.is_restated:
        return library.package.rpartition("@")[2]
    if library.is_debian:
        asked_for = ["dpkg-query", "--show", "--showformat", "${Version}", library.package]
        return subprocess.run(asked_for, capture_output=True, text=True, check=True).stdout
    return importlib.metadata.version(library.package)

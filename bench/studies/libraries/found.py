"""Which libraries can be asked: every file in bench/studies/libraries/asked whose library is installed here."""

import functools
import importlib
import importlib.metadata
import pkgutil
import subprocess
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
    """Of its package, as installed; of what is restated, the commit that was read, which its `package` ends with."""
    if library.is_restated:
        return library.package.rpartition("@")[2]
    if library.is_debian:
        asked_for = ["dpkg-query", "--show", "--showformat", "${Version}", library.package]
        return subprocess.run(asked_for, capture_output=True, text=True, check=True).stdout
    return importlib.metadata.version(library.package)

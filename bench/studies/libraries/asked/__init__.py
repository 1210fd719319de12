"""Every library that is tested, one function each; of one that is not installed here a line says why it is left out."""

import functools
import importlib.metadata
import inspect
import subprocess
from typing import NamedTuple

from bench.base.errors import UnknownWord
from bench.studies.libraries.asked import compiled, controllers, ours, rotations, simulators
from bench.studies.libraries.library import Library

ASKED = {
    name: one
    for module in (rotations, compiled, controllers, simulators, ours)
    for name, one in inspect.getmembers(module, inspect.isfunction)
    if inspect.signature(one).return_annotation == list[Library]
}
"""Word of the command line -> function of these modules that returns libraries."""


class Found(NamedTuple):
    """The libraries that import, and of the others the name and why not."""

    libraries: tuple[Library, ...]
    missing: dict[str, str]


@functools.cache
def find(*names: str) -> Found:
    """Import what is there, or of it the libraries of these names alone; UnknownWord if no function has a name."""
    libraries: list[Library] = []
    missing = {}
    for name in names or sorted(ASKED):
        if name not in ASKED:
            raise UnknownWord("library", name, list(ASKED))
        try:
            libraries += ASKED[name]()
        except ImportError as error:  # not installed, or no compiler
            missing[name] = str(error)
    return Found(tuple(libraries), missing)


def version_of(library: Library) -> str:
    """Return the installed version; of restated code, the commit that was read, which its `package` ends with."""
    if library.is_restated:
        return library.package.rpartition("@")[2]
    if library.is_debian:
        query = ["dpkg-query", "--show", "--showformat", "${Version}", library.package]
        return subprocess.run(query, capture_output=True, text=True, check=True).stdout
    return importlib.metadata.version(library.package)

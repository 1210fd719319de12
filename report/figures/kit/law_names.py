"""Laws called in sentences as the book calls them: MRP with memory, not mrp-memory."""

import functools
import re

from bench.law.contenders.registry import all_contenders
from report.figures.kit import families


@functools.cache
def find_names() -> re.Pattern[str]:
    """Return a pattern that finds a law as the terminal prints it, but not in "the rotation-matrix law"."""
    names = sorted((contender.name for contender in all_contenders()), key=len, reverse=True)
    return re.compile(rf"(?<![\w/-])({'|'.join(map(re.escape, names))})(?![\w/-]| law)")


def call_laws(text: str) -> str:
    """Return a text with the laws called as the book calls them: MRP with memory, not mrp-memory."""
    return find_names().sub(lambda name: families.word(name[0]), text)

"""Parts of files: templates that are filled in, and lines of comment."""

import re
import textwrap
from pathlib import Path

from bench.translation.layout import WIDTH


def fill_template(name: str, **texts: object) -> str:
    """Return a file of bench/export/languages/templates with texts in place of these words."""
    template = Path(__file__).with_name("languages").joinpath("templates", name).read_text(encoding="utf-8")
    return re.sub("|".join(texts), lambda word: str(texts[word[0]]), template) if texts else template


def slashes(text: str) -> list[str]:
    """Return a text as lines of comment of C++ and JavaScript."""
    return [f"// {line}" for line in textwrap.wrap(text, WIDTH - 4)]

"""What a language of the export is: the record that each file of bench/export/languages holds."""

import importlib
import json
import pkgutil
from collections.abc import Callable, Sequence
from typing import NamedTuple

from bench.errors import UnknownWord
from bench.export import languages
from bench.export.heading import BY_ROWS, RESET, SIDE
from bench.export.shaken import ULPS
from bench.export.subject import Subject
from bench.export.vectors import Vector


class Language(NamedTuple):
    """law(subject) -> (name of its file, text). files(subject) -> file name -> text: it, its test, and what they need.

    test: the command that runs the test of an export in its folder, with {name} for the subject's identifier.
    """

    name: str
    title: str
    law: Callable[[Subject], tuple[str, str]]
    files: Callable[[Subject], dict[str, str]]
    test: str


def language_words() -> list[str]:
    """Every language: the names of the files of bench/export/languages."""
    return [one.name for one in pkgutil.iter_modules(languages.__path__)]


def find_language(word: str) -> Language:
    """The constant LANGUAGE of the file of that name."""
    if word not in language_words():
        raise UnknownWord("language", word, language_words())
    return importlib.import_module(f"{languages.__name__}.{word}").LANGUAGE


def as_json(subject: Subject, found: Sequence[Vector]) -> str:
    """The vectors as every language may read them, a line each; numbers read back as the same bits."""
    lines = ",\n".join(json.dumps(one._asdict(), allow_nan=False) for one in found)
    about = json.dumps({"law": subject.word, "matrices": "row-major", "frame": "base, but what ends in _body"})
    return f'{{"about": {about},\n"vectors": [\n{lines}\n]}}\n'


def readme(subject: Subject, language: Language) -> str:
    """How the export is tried."""
    remembered = f"\n**Memory.** {RESET} {SIDE}\n" if subject.memory else ""
    return (
        f"# {subject.record.title}, {language.title}\n\nTry it in this folder:\n\n```sh\n"
        f"{language.test.format(name=subject.identifier)}\n```\n\n"
        "`vectors.json` has questions and our own answers. Where `tolerance` is 0 the answers are equal bit for bit if "
        "the compiler fuses no product with a sum (`-ffp-contract=off`); elsewhere it covers sines, cosines and arcs "
        f"off by {ULPS:g} units in the last place. The file of the law says first what it is and where it fails.\n\n"
        f"**Matrices** in arrays and in `vectors.json` are {BY_ROWS.partition('  ')[2]}.\n{remembered}"
    )

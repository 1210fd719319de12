"""Languages of the export: the record that each file of bench/export/languages holds."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from bench.base.errors import UnknownWord
from bench.export import languages
from bench.export.entries import Entry
from bench.export.heading import BY_ROWS, LICENSE, RESET, SIDE
from bench.export.subject import Subject
from bench.export.vectors import CLOSE, vectors
from tasks.discovery import constants


class Language(NamedTuple):
    """A language: how it writes the file of a subject and the test of it.

    paths: of the two files, with {name} for the subject's identifier. test: the command that runs the test of an export
    in its folder. notes: more for its README. beside: writes the other files that the law's needs, by path.
    """

    name: str
    title: str
    paths: tuple[str, str]
    write_law: Callable[[Subject], str]
    write_test: Callable[[Subject], str]
    test: str
    notes: str = ""
    beside: Callable[[Subject], dict[str, str]] = lambda subject: {}

    def law(self, subject: Subject) -> dict[str, str]:
        """Return the file of a subject and those that it needs, by path."""
        return {self.paths[0].format(name=subject.identifier): self.write_law(subject), **self.beside(subject)}

    def files(self, subject: Subject) -> dict[str, str]:
        """Return the files of an export by path: the law, its test, and what they need."""
        return {
            **self.law(subject),
            self.paths[1].format(name=subject.identifier): self.write_test(subject),
            "LICENSE": LICENSE,
            "vectors.json": write_vectors(subject),
            "README.md": write_readme(subject, self),
        }


def language_words() -> list[str]:
    """Return every language: the names of the files of bench/export/languages."""
    return list(constants(languages, "LANGUAGE"))


def find_language(word: str) -> Language:
    """Return the constant LANGUAGE of the file of that name."""
    every = constants(languages, "LANGUAGE")
    if word not in every:
        meant = (name for name, one in every.items() if one.title.casefold().startswith(word.casefold()))
        raise UnknownWord("language", word, list(every), next(meant, None))
    return every[word]


def write_arguments(entry: Entry, *forms: Mapping[str, str]) -> Iterator[str]:
    """Yield the parameters of an entry as one list of arguments for each form.

    forms: templates by kind of a parameter, "" for all other kinds, with {name}, {size} and {at}, its place in a row.
    """
    for by in forms:
        places = itertools.accumulate((one.size for one in entry.parameters), initial=0)
        placed = zip(entry.parameters, places, strict=False)
        yield ", ".join(by.get(one.kind, by[""]).format(name=one.name, size=one.size, at=at) for one, at in placed)


def write_vectors(subject: Subject) -> str:
    """Write the vectors as JSON, one a line; numbers read back as the same bits."""
    lines = ",\n".join(json.dumps(one._asdict(), allow_nan=False) for one in vectors(subject))
    about = json.dumps({"law": subject.word, "matrices": "row-major", "frame": "base, except for what ends in _body"})
    return f'{{"about": {about},\n"vectors": [\n{lines}\n]}}\n'


def write_readme(subject: Subject, language: Language) -> str:
    """Write how to try the export."""
    remembered = f"\n**Memory.** {RESET} {SIDE}\n" if subject.memory else ""
    names = (name for name in language.beside(subject) if name.startswith("short_"))
    short = "".join(f"`{name}` is the law in at most 12 lines of NumPy. " for name in names)
    return (
        f"# {subject.record.title}, {language.title}\n\nTry it in this folder:\n\n```sh\n"
        f"{language.test.format(name=subject.identifier)}\n```\n\n"
        "`vectors.json` has the benchmark's own answers. Where `tolerance` is 0 the answers are equal bit for bit if "
        "the compiler fuses no product with a sum (`-ffp-contract=off`); elsewhere sines, cosines and "
        f"arcs of another library change last digits, and the tolerance is {CLOSE:g} of the largest number of the "
        f"answer. {short}The file of the law says what it is and where it fails.\n\n**Matrices** in `vectors.json` are "
        f"{BY_ROWS.partition('  ')[2]}.\n{remembered}{language.notes}"
    )

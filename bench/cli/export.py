"""`export`: laws as code for your own controller."""

import functools
from pathlib import Path

import rich_click as click

from bench.base.files import write_atomically
from bench.cli import options
from bench.cli.screen import console, examples, shown_path

EVERYTHING = "all"
FOLDER = Path("export")


@click.command("export", epilog=examples("export"))
@click.argument("law")
@click.option("--to", "language", required=True, metavar="LANGUAGE", help="c, cpp, js, python (with NumPy) or rust.")
@click.option("--out", type=options.PATH, help="Folder to write to (default: export/LANGUAGE/LAW).")
@options.law
def COMMAND(law: str, language: str, out: Path | None, laws: options.Files) -> None:
    """Write a LAW as code for your controller, translated from its one source, with test vectors.

    A law is named as in `list regulators`, with its coordinates where it has several; representation-NAME are the
    functions of coordinates, impedance-NAME an impedance, spring-NAME a spring, of a pose or of a
    rotation alone, compensator-NAME a law with a state. --law FILE runs your file in a process of its own.
    """
    from bench.export.apart import files_apart
    from bench.export.language import find_language
    from bench.export.subject import find_subject, identifier_of, subject_words
    from bench.law.contenders import registry

    made, own = find_language(language), {one.name: one for one in options.own_laws(laws)}
    words = subject_words(tuple(own.values())) if law == EVERYTHING else [law]
    for word in words:
        theirs = own.get(word.partition("/")[0])
        if theirs is not None and theirs.origin:
            name = identifier_of(registry.find_contender(word, (theirs,)).on_free_body)
            files = files_apart(theirs, word, language)
        else:
            subject = find_subject(word, tuple(own.values()))
            name, files = subject.identifier, made.files(subject)
        folder = FOLDER / language / name if out is None else out / name if law == EVERYTHING else out
        _write(folder, files)
        console().print(f"wrote {shown_path(folder)}; try it there:", soft_wrap=True)
        console().print(f"  {made.test.format(name=name)}", soft_wrap=True)


def _write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        write_atomically(folder / name, functools.partial(_fill, text))


def _fill(text: str, path: Path) -> None:
    Path(path).write_text(text, encoding="utf-8")

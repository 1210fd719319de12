"""The export of a user's law, made in this process of its own, which gives back names of files and their texts."""

import re
from pathlib import Path

from bench.base.errors import BadLaw
from bench.base.isolated import TimeLimits
from bench.export.language import find_language
from bench.export.subject import find_subject
from bench.law.contenders.law_file import load_law
from bench.law.contenders.law_process import answer, ask
from bench.law.kinds import Law

LIMITS = TimeLimits(processor_s=60.0, wall_s=300.0)
"""Time limits for the export of one law: ten times what ours take."""

NAME = re.compile(r"(src/|tests/)?[A-Za-z0-9_][A-Za-z0-9_.]{0,120}")


def files_apart(own: Law, word: str, language: str) -> dict[str, str]:
    """Return the files of the export of a user's law by name; BadLaw if its process gives back none."""
    asked = {"text": own.text, "origin": own.origin, "word": word, "language": language}
    said = ask(__name__, asked, LIMITS, own.origin).get("files")
    files: dict[str, str] = said if isinstance(said, dict) else {}
    is_known = all(NAME.fullmatch(name) and isinstance(text, str) for name, text in files.items())
    if not is_known or not {"README.md", "vectors.json"} <= set(files):
        raise BadLaw(f"--law {own.origin}: its process gave back no files; correct what runs on import")
    return files


def translate(asked: dict, path: Path | None) -> dict:
    """Load the law and return its files."""
    own = load_law(path or Path(), asked["text"].encode())
    return {"files": find_language(asked["language"]).files(find_subject(asked["word"], (own,)))}


if __name__ == "__main__":
    answer(translate)

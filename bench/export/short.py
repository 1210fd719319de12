"""Short forms: a law in at most 12 lines of NumPy, which JAX and PyTorch run too (short.toml)."""

import tomllib
from pathlib import Path

from bench.export.subject import Subject

FORMS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def write_short(word: str) -> str:
    """Return the short form of a law with the functions that it calls, where `np` is imported; empty if it has none."""
    laws, shared = FORMS["laws"], FORMS["shared"]
    law = laws.get(word, "")
    law = laws.get(law, law)
    called = [text for name, text in shared.items() if f"{name}(" in law]
    damped = [FORMS["spring_damper"]] if law and "def angular_acceleration" not in law else []
    return "\n\n".join((*called, law, *damped))


def short_files(subject: Subject) -> dict[str, str]:
    """Return the file of a short form by its name; nothing of a subject that has none."""
    code, name, record = write_short(subject.word).replace("\n\n", "\n\n\n"), subject.identifier, subject.record
    memory = FORMS["memory"].format(subject.memory) if subject.memory else ""
    about = FORMS["about"].format(title=record.title, name=name, formula=record.formula, memory=memory)
    return {f"short_{name}.py": f"{about}{code}\n"} if code else {}

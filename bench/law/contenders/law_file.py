"""A user's law: the one file outside the package that holds a REGULATOR."""

import ast
import functools
import hashlib
import linecache
import re
import sys
import tempfile
import traceback
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bench import law
from bench.base.errors import BadLaw
from bench.law.attribution import YOURS
from bench.law.contender import Contender
from bench.law.contenders.registry import contenders, contenders_of, representation
from bench.law.display import COLOURS, LINES, MARKERS, Equation, Look
from bench.law.inputs import NO_MEMORY, Goal, Tuning
from bench.law.kinds import FORMER_FIELDS, USERS_ROLES, Law, OnCoordinates, UserFile
from bench.law.so3 import Rotation

WORD = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
"""A name as rows, file names and the command line write it."""

LONGEST_NAME, MOST_BYTES = 60, 1 << 20
"""Letters of a law's name, which names files, and bytes of its file."""

LONGEST = 32
SHORT = re.compile(rf"[\w ,.'-]{{0,{LONGEST}}}")
"""Characters allowed in the name beside a curve; markup and formulas would break a figure."""


def read_law(path: Path) -> bytes:
    """Return the text of a user's law file; BadLaw: it cannot be read."""
    if not path.is_file():
        raise BadLaw(f"{path}: there is no such file; give the path of a Python file with a constant REGULATOR")
    try:
        text = path.read_bytes()
        if len(text) > MOST_BYTES:
            raise BadLaw(f"--law {path}: it has {len(text):,} bytes, and a law has up to {MOST_BYTES:,}; shorten it")
        text.decode()
    except OSError as error:
        raise BadLaw(f"--law {path}: it cannot be read ({error.strerror}); run: chmod u+r on it") from error
    except UnicodeDecodeError as error:
        raise BadLaw(
            f"--law {path}: it is not UTF-8 ({error.reason} at byte {error.start}); save it as UTF-8"
        ) from error
    return text


@functools.lru_cache(maxsize=32)
def keep_text(text: str) -> Path:
    """Write the text of a user's law to a file that lasts as long as this process, once a text."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    path = Path(_folder().name) / f"law_{digest}.py"
    path.write_text(text, encoding="utf-8")
    return path


@functools.cache
def _folder() -> tempfile.TemporaryDirectory:
    return tempfile.TemporaryDirectory(prefix="orientation-bench-laws-")


def load_law(path: Path, text: bytes | None = None) -> Law:
    """Return the REGULATOR of a file outside the package, or of its text: in a law's own process, for this runs it.

    The module's name carries a digest of the file, so that nothing of an earlier version is ever reused.

    Errors:
        BadLaw: the file is missing, does not import, or lacks a REGULATOR that can be used.
    """
    path = Path(path)
    text = read_law(path) if text is None else text
    name = f"user_law_{path.stem}_{hashlib.sha256(text).hexdigest()[:12]}"
    module = types.ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module
    # Who translates the law reads its text here, whatever becomes of the file.
    linecache.cache[str(path)] = (len(text), None, text.decode("utf-8-sig").splitlines(keepends=True), str(path))
    try:
        exec(compile(text, path, "exec"), module.__dict__)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise BadLaw(f"--law {path}: it does not import ({_said(error, str(path))}); {_cure(error, text)}") from error
    own = getattr(module, "REGULATOR", None)
    if not isinstance(own, Law):
        given = "no REGULATOR" if own is None else f"a REGULATOR of type {type(own).__name__}"
        raise BadLaw(f"--law {path}: it has {given}; it needs a constant REGULATOR = bench.law.Law(...) (see README)")
    check_fields(own, path)
    if own.name in contenders("regulators"):
        raise BadLaw(f"--law {path}: the name '{own.name}' is one of ours; give your REGULATOR another name")
    # Whatever the file says of itself: nobody here has compared a user's law with a work.
    return own._replace(file=UserFile(str(path), text.decode()), attribution=YOURS)


CURES = {
    "level": "omit it, for a law commands an angular acceleration",
    "gains": "omit it, for a law is called with its gains",
    "in_engine": "omit it, for MuJoCo's own actuator would run in place of the law",
    "costing_only": 'write role="costing"',
    "control": 'write role="control"',
    **dict.fromkeys(("relative", "coordinate_law_in"), "write it in law=OnCoordinates(law_in, coordinates, ...)"),
    "papers": "omit it, for the paper's laws are those of bench/law/contenders",
    **dict.fromkeys(("shipped", "state"), "omit it, for only files in contenders/ have it, in a record with a law"),
}
"""What to write in place of a field that a `Law` had before."""



def note_former_fields(text: str) -> str:
    """Return a note on fields of a `Law` that a file writes by their former names; empty if there are none."""
    try:
        # Of bytes, for a text may begin with a mark of its coding.
        nodes = list(ast.walk(ast.parse(text.encode())))
    except (SyntaxError, RecursionError):
        return ""
    keywords: set[str | None] = set()
    for node in nodes:
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] == Law.__name__:
            keywords |= {keyword.arg for keyword in node.keywords}
    changes = []
    for former, field in FORMER_FIELDS.items():
        if former in keywords:
            changes.append(f"write {field}= in place of {former}=")
    return (
        f"{'; '.join(changes)} (the former name is accepted for one more release)"
        if changes
        else ""
    )


NO_FIELD = re.compile(r".*unexpected keyword argument '(\w+)'.*", re.DOTALL)


def _cure(error: BaseException, text: bytes) -> str:
    """Return what to write in a file that does not import."""
    if isinstance(error, ImportError):
        return _new_imports(text)
    field = NO_FIELD.sub(r"\1", str(error))
    return CURES.get(field, "correct the file")


def _new_imports(text: bytes) -> str:
    """Return what to write in place of imports from modules of ours that are there no more."""
    old = [
        one
        for one in ast.walk(ast.parse(text))
        if isinstance(one, ast.ImportFrom) and re.match(r"bench\.(?!law\b)", one.module or "")
    ]
    names = {law.RENAMED.get(name.name, name.name) for one in old for name in one.names}
    moved = sorted(name for name in names if name in law.__dict__)
    return f"write: from bench.law import {', '.join(moved)}" if moved else "correct the file"


TRIAL = Rotation((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6))
"""A rotation with short decimals, away from every singular set we know: where a law is tried once."""


def check_fields(own: Law, path: Path) -> None:
    """Check the fields of a user's law before anything is made of them."""
    for problem in _problems(own):
        raise BadLaw(f"--law {path}: {problem}")
    for word in own.coordinates if isinstance(own.coordinates, tuple) else ():
        representation(word)


def _problems(own: Law) -> Iterator[str]:
    """Yield what is wrong with the fields of a law."""
    memory = own.memory or ()
    shown: Any = own.display
    if not (isinstance(own.name, str) and WORD.fullmatch(own.name) and len(own.name) <= LONGEST_NAME):
        yield (
            f"its name {_shown(own.name)} is no word of a-z, 0-9 and dashes, such as 'my-law', of up to "
            f"{LONGEST_NAME} letters"
        )
    if not all(isinstance(text, str) for text in (own.title, own.source, own.formula, own.property)):
        yield "title, source, formula and property must be texts"
    if not all(isinstance(text, str) and SHORT.fullmatch(text) for text in (shown.short, shown.family)):
        yield (
            f"its short name and family are {_shown((shown.short, shown.family))}; give texts of at most {LONGEST} "
            "letters, digits, spaces and , . ' -"
        )
    if not (shown.look is None or (isinstance(shown.look, Look) and shown.look.is_known)):
        yield (
            f"its look is {_shown(shown.look)}; give a bench.law.Look of a colour ({', '.join(COLOURS)}), a marker "
            f"({' '.join(MARKERS)}) and a line ({', '.join(LINES)})"
        )
    if not (shown.equation is None or isinstance(shown.equation, Equation) or callable(shown.equation)):
        yield f"its equation is {_shown(shown.equation)}; give a bench.law.Equation(formula, spring)"
    yield from _problems_of_function(own.law)
    if not (isinstance(memory, tuple) and len(memory) <= len(NO_MEMORY) and all(isinstance(x, float) for x in memory)):
        yield f"its memory is {own.memory!r}; give None or a tuple of up to {len(NO_MEMORY)} floats"
    if own.role not in USERS_ROLES:
        yield f"its role is {_shown(own.role)}; omit it, or give one of {', '.join(USERS_ROLES)}"


def _problems_of_function(law: Any) -> Iterator[str]:
    """Yield what is wrong with the function of a law, or with what it has on coordinates."""
    if not isinstance(law, OnCoordinates):
        if not callable(law):
            yield f"its law is {_shown(law)}; give a function, or on coordinates OnCoordinates(law_in, names)"
        return
    if not (law.names == "any" or (law.names and isinstance(law.names, tuple))):
        yield f"its coordinates are {law.names!r}; allowed: 'any', a tuple of names"
    if not callable(law.law_in):
        yield f"its law_in is {_shown(law.law_in)}; on {law.names!r} coordinates give a function"


MISTAKES = (TypeError, NameError, AttributeError, ImportError)
"""What a law raises that was written wrongly; anything else it may raise in some state, and that is a row."""


def _tried(one: Contender):
    """Return what the law answers at TRIAL."""
    first = one.regulator.memory
    memory = () if first is None else ((*first, *NO_MEMORY[len(first) :]),)
    return one.law(TRIAL, (0.1, 0.2, 0.3), Goal(), Tuning(), *memory)


def trial_error(one: Contender) -> str:
    """Return what the law raises at TRIAL, and in which line of its file; nothing if it answers."""
    try:
        _tried(one)
    except Exception as error:
        return _said(error, one.regulator.origin)
    return ""


def _said(error: BaseException, origin: str) -> str:
    """Return an error, and the last line of the user's file that it passed."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == origin]
    where = f" in line {lines[-1]}" if lines else ""
    return f"{type(error).__name__}{where}: {error}"


def check_answers(own: Law) -> None:
    """Call the law once in each of its representations; BadLaw: it does not return three numbers (and a memory)."""
    has_memory = own.memory is not None
    arguments = "R, omega, goal, gains, memory" if has_memory else "R, omega, goal, gains"
    for one in contenders_of(own):
        is_from = f"--law {own.origin}: the law of '{one.name}'"
        try:
            answer = _tried(one)
        except MISTAKES as error:
            raise BadLaw(
                f"{is_from} cannot be called as law({arguments}) ({_said(error, own.origin)}); see the example in "
                "README"
            ) from error
        except Exception:
            continue  # a law that raises in an episode is a row, not a mistake of the caller
        if has_memory:
            memory = answer[1] if isinstance(answer, tuple) and len(answer) == 2 else None
            if not (isinstance(memory, tuple) and len(memory) == 4):
                raise BadLaw(
                    f"{is_from} has memory and returned {_shown(answer)}; it must return (command, memory) with a "
                    "memory of four floats"
                )
            answer = answer[0]
        if not (isinstance(answer, tuple) and len(answer) == 3 and all(isinstance(x, float) for x in answer)):
            raise BadLaw(
                f"{is_from} returned {_shown(answer)}; it must return a tuple of three floats, the angular "
                "acceleration in the base frame"
            )


def _shown(answer) -> str:
    text = repr(answer)
    return text if len(text) <= 60 else text[:57] + "..."

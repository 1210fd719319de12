"""Why a user's law cannot be compiled, in the words of a law's file, and what to write instead.

Numba names the pass that failed and its own types; three slips are known by its messages: a function without @kernel,
a list or an object of the module that the law changes, and a global that it assigns.
"""

import re

from bench.base.errors import BadLaw
from bench.translation.dialect import STATE

DIALECT = (
    "keep to the dialect of bench/law/scalar.py and mark functions with @kernel "
    "(bench run --engine reference runs a law that is not compiled)"
)
FUNCTION = re.compile(r"Untyped global name '(\w+)': Cannot determine Numba type of <class 'function'>")
OBJECT = re.compile(
    r"Untyped global name '(?P<name>\w+)': Cannot (?:type|determine)"
    r"|use of a reflected .*? assigned to variable '(?P<list>\w+)' in globals"
)
ASSIGNED = re.compile(r"unsupported opcode \((?:STORE|DELETE)_GLOBAL\)")
FIXED_ARRAY = re.compile(r"setitem\(readonly array")


def explain_failure(error: Exception) -> str:
    """Return why a law cannot be compiled and the cure, as "reason; cure"."""
    if isinstance(error, BadLaw):  # of the translator, which names function and expression
        has_cure = any(cure in str(error) for cure in (STATE, "put @kernel above"))
        return str(error) if has_cure else f"{error}; {DIALECT}"
    reason = _deepest_reason(error)
    if plain := FUNCTION.search(reason):
        return f"'{plain[1]}' is a plain function of Python; put @kernel above def {plain[1]}"
    if kept := OBJECT.search(reason):
        name = kept["name"] or kept["list"]
        return f"'{name}' of the file is no number, tuple or kernel; {STATE}"
    if ASSIGNED.search(reason):
        return f"it assigns a global of the file; {STATE}"
    if FIXED_ARRAY.search(reason):
        return f"it changes an array of the file; {STATE}"
    return f"{reason}; {DIALECT}"


def _deepest_reason(error: Exception) -> str:
    """Return the line of numba's report that is about the law; it reports each caller before the callee."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()] or [type(error).__name__]
    deepest = max((i for i, line in enumerate(lines[:-1]) if "Failed in nopython mode" in line), default=-1)
    reason, *after = lines[deepest + 1 :]
    return f"{reason} {after[0].removeprefix('>>> ')}" if reason.endswith("signature:") and after else reason

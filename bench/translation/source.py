"""The syntax tree of a function, from its file as it was when the function was imported."""

import ast
import copy
import functools
import inspect
import linecache
import textwrap
import types
from collections.abc import Callable, Iterator
from typing import NamedTuple

from bench.base.errors import BadLaw

Place = tuple[str, int]
"""The name of a function, and its first line in its file."""


class FunctionsOfFile(NamedTuple):
    """The functions of a file: their trees, and the byte code of their text as it is on disk."""

    trees: dict[Place, ast.FunctionDef]
    codes: dict[Place, types.CodeType]


def tree_of(function: Callable) -> ast.FunctionDef:
    """Return the tree of a function, which is the caller's to change.

    Errors:
        BadLaw: There is no text, it is no `def`, or its file has changed since it was imported.
    """
    code = function.__code__
    text = "".join(linecache.getlines(code.co_filename))
    try:
        file = read_file(code.co_filename, text)
    except (SyntaxError, ValueError):
        return _tree_by_inspection(function)
    if code.co_name == "<lambda>":
        raise BadLaw(f"{function.__qualname__}: a law is a function written with def, not a lambda")
    here = code.co_name, code.co_firstlineno
    for place in (here, *file.codes):  # lines may have moved
        if place in file.trees and place[0] == code.co_name and _does_the_same(file.codes[place], code):
            return copy.deepcopy(file.trees[place])
    if not text:
        raise BadLaw(f"{function.__qualname__}: its source cannot be read; keep the law in a file")
    raise BadLaw(f"{code.co_filename}: {function.__qualname__} was edited while this ran; run it again")


def _does_the_same(first: types.CodeType, second: types.CodeType) -> bool:
    return first.co_code == second.co_code and _words_of(first) == _words_of(second)


def _words_of(code: types.CodeType) -> tuple:
    """Return the names of a code and its constants, without docstrings and inner code."""
    constants = [repr(one) for one in code.co_consts if not isinstance(one, str | types.CodeType)]
    return code.co_names, code.co_varnames, code.co_freevars, constants


def _tree_by_inspection(function: Callable) -> ast.FunctionDef:
    try:
        text = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError) as error:
        raise BadLaw(f"{function.__qualname__}: its source cannot be read ({error}); keep the law in a file") from error
    node = ast.parse(text).body[0]
    if not isinstance(node, ast.FunctionDef):
        raise BadLaw(f"{function.__qualname__}: a law is a function written with def, not {type(node).__name__}")
    return node


@functools.lru_cache(maxsize=512)
def read_file(path: str, text: str) -> FunctionsOfFile:
    """Return the functions of the text of a file."""
    tree = ast.parse(text)
    trees = {
        (node.name, min([node.lineno, *(one.lineno for one in node.decorator_list)])): node
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
    }
    compiled = _list_codes(compile(text, path, "exec", dont_inherit=True))
    return FunctionsOfFile(trees, {(code.co_name, code.co_firstlineno): code for code in compiled})


def _list_codes(code: types.CodeType) -> Iterator[types.CodeType]:
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield constant
            yield from _list_codes(constant)

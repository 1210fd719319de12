"""A program: typed functions, callees first."""

import ast
import functools
from collections.abc import Callable

from bench.base.errors import BadLaw
from bench.translation.dialect import LAWS, Dialect, read_function, require_mark
from bench.translation.inference import Typed
from bench.translation.kinds import Kind, Tuple, kind_of, kind_of_constant

CALLS_OF_LIBM = {"sin", "cos", "acos", "atan2"}


class Program:
    """Typed functions, callees first, each with a unique name, without those that return an argument as it is."""

    def __init__(self, dialect: Dialect = LAWS, needs_marks: bool = False) -> None:
        self.dialect = dialect
        self.needs_marks = needs_marks
        self.entries: dict[str, Typed] = {}
        self._roots: list[Typed] = []
        self._order: list[Typed] = []
        self._done: dict[tuple, Typed] = {}
        self._begun: set[tuple] = set()
        self._names: set[str] = set()
        self.read = functools.cache(functools.partial(read_function, dialect=dialect))
        self.kind_of = kind_of if dialect.has_integers else kind_of_constant

    def add(self, function: Callable, kinds: tuple[Kind, ...]) -> Typed:
        """Add a function for these kinds of its arguments, and all that it calls."""
        root = self.typed(function, kinds)
        self._roots.append(root)
        return root

    def typed(self, function: Callable, kinds: tuple[Kind, ...]) -> Typed:
        """Return a function for these kinds of its arguments, which another one calls."""
        if (function, kinds) not in self._done:
            if self.needs_marks:
                require_mark(function)
            if (function, kinds) in self._begun:
                raise BadLaw(f"{function.__name__} calls itself, and that cannot be translated")
            self._begun.add((function, kinds))
            self._done[function, kinds] = typed = Typed(self, self.read(function), kinds)
            if typed.identity is None:
                self._order.append(typed)
        return self._done[function, kinds]

    @property
    def functions(self) -> list[Typed]:
        """Return every function that is called, callees first.

        One that only a try at a narrower kind has called is left out.
        """
        called: set[Typed] = set()
        waiting = list(self._roots)
        while waiting:
            function = waiting.pop()
            if function not in called:
                called.add(function)
                waiting += function.calls.values()
        return [function for function in self._order if function in called]

    @property
    def is_algebraic(self) -> bool:
        """Tell whether it takes only sums, products, quotients and roots, which every processor rounds alike."""
        trees = (one for function in self.functions for one in ast.walk(function.node) if isinstance(one, ast.Call))
        return not {one.func.id for one in trees if isinstance(one.func, ast.Name)} & CALLS_OF_LIBM

    def name(self, wanted: str) -> str:
        """Return the wanted name, with a number after it if it is taken, and reserve it."""
        name, number = wanted, 2
        while name in self._names:
            name, number = f"{wanted}_{number}", number + 1
        self._names.add(name)
        return name

    @property
    def tuples(self) -> list[Tuple]:
        """Return every kind of tuple in use, its parts before it."""
        found: dict[Tuple, None] = {}
        for one in self.functions:
            for kind in (*one.parameters.values(), *one.kinds.values(), one.returns):
                _collect(kind, found)
        return list(found)


def _collect(kind: Kind, found: dict) -> None:
    if isinstance(kind, Tuple):
        for item in kind.items:
            _collect(item, found)
        found.setdefault(kind)

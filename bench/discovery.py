"""Finding what exists: every module of a folder that holds the one named constant, and a user's files.

Nothing registers itself; dropping a file is enough. The file name, underscores turned to dashes, must be the
constant's name.
"""

import functools
import hashlib
import importlib
import pkgutil
import re
import sys
import types
from pathlib import Path
from typing import Any

from bench import contact_metrics, impedances, inverses, jacobians, metrics, regulators, representations
from bench.compliance import ALONG_AXES, FORMS, HYBRIDS, Compliant, hybrid, springy
from bench.contender import NO_MEMORY, Contender, Gains, Goal, Regulator, Representation, contender
from bench.errors import BadLaw, Incompatible, UnknownWord
from bench.impedance import Impedance
from bench.metric import Metric
from bench.resolved_motion import Inverse, Jacobian
from bench.so3 import Rotation

WORD = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
"""A name as rows, file names and the command line write it."""


def _collect(package, constant: str, kind: type) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for module_info in pkgutil.iter_modules(package.__path__):
        module = importlib.import_module(f"{package.__name__}.{module_info.name}")
        value: Any = getattr(module, constant, None)
        if not isinstance(value, kind):
            raise BadLaw(f"{module.__file__} has no {constant} that is a {kind.__name__}; each file there needs one")
        word, name = module_info.name.replace("_", "-"), getattr(value, "name", None)
        if name != word:
            raise BadLaw(f"{module.__file__}: {constant}.name is '{name}', but the file's name makes it '{word}'")
        found[word] = value
    return found


@functools.cache
def known_representations() -> dict:
    """Word -> Representation, from bench/representations."""
    return _collect(representations, "REPRESENTATION", Representation)


@functools.cache
def known_regulators() -> dict:
    """Word -> Regulator, from bench/regulators."""
    return _collect(regulators, "REGULATOR", Regulator)


@functools.cache
def known_jacobians() -> dict:
    """Word -> Jacobian, from bench/jacobians."""
    return _collect(jacobians, "JACOBIAN", Jacobian)


@functools.cache
def known_inverses() -> dict:
    """Word -> Inverse, from bench/inverses."""
    return _collect(inverses, "INVERSE", Inverse)


@functools.cache
def known_metrics() -> dict:
    """Word -> Metric, from bench/metrics, in alphabetical order: the order of their columns."""
    return _collect(metrics, "METRIC", Metric)


@functools.cache
def known_impedances() -> dict:
    """Word -> Impedance, from bench/impedances."""
    return _collect(impedances, "IMPEDANCE", Impedance)


@functools.cache
def known_contact_metrics() -> dict:
    """Word -> ContactMetric, from bench/contact_metrics, in alphabetical order: the order of their columns."""
    from bench.contact_metric import ContactMetric  # MuJoCo takes a moment to import; naming other things must not

    return _collect(contact_metrics, "METRIC", ContactMetric)


def metrics_of(on_arm: bool) -> tuple[Metric, ...]:
    """The metrics that can be measured on an arm (all), or on the free body."""
    return tuple(one for one in known_metrics().values() if on_arm or not one.arm_only)


def contenders_of(regulator: Regulator) -> list[Contender]:
    """A regulator in every representation it acts on."""
    if regulator.coordinates == "rotation-matrix":
        return [contender(regulator)]
    every = known_representations()
    words = every if regulator.coordinates == "any" else regulator.coordinates
    return [contender(regulator, representation(word)) for word in words]


def all_contenders(extra: tuple[Regulator, ...] = ()) -> list[Contender]:
    """Every regulator in every representation it acts on, costings included; then the user's own."""
    return [one for regulator in (*known_regulators().values(), *extra) for one in contenders_of(regulator)]


def regulator(word: str, extra: tuple[Regulator, ...] = ()) -> Regulator:
    """The regulator of that name, the user's own among them."""
    every = known_regulators() | {own.name: own for own in extra}
    if word not in every:
        raise UnknownWord("regulator", word, sorted(every))
    return every[word]


def representation(word: str):
    """The representation of that name."""
    every = known_representations()
    if word not in every:
        raise UnknownWord("representation", word, sorted(every))
    return every[word]


def jacobian(word: str) -> Jacobian:
    """The Jacobian of that name."""
    every = known_jacobians()
    if word not in every:
        raise UnknownWord("Jacobian", word, sorted(every))
    return every[word]


def inverse(word: str) -> Inverse:
    """The inverse of that name."""
    every = known_inverses()
    if word not in every:
        raise UnknownWord("inverse", word, sorted(every))
    return every[word]


def find_contender(word: str, extra: tuple[Regulator, ...] = ()) -> Contender:
    """`regulator[/representation][@jacobian+inverse]`, as rows and the command line write it.

    Errors:
        UnknownWord: a part that is in no list. Incompatible: no representation is named, and the regulator acts on
        several.
    """
    law, _, way = word.partition("@")
    name, _, coordinates = law.partition("/")
    chosen = regulator(name, extra)
    several = contenders_of(chosen)
    if coordinates:
        one = contender(chosen, representation(coordinates))
    elif len(several) == 1:
        one = several[0]
    else:
        choices = ", ".join(each.name for each in several)
        raise Incompatible(f"regulator '{name}' acts on several coordinates; name one: {choices}")
    if not way:
        return one
    by, _, through = way.partition("+")
    return one._replace(jacobian=jacobian(by), inverse=inverse(through))


def all_compliants() -> list[Compliant]:
    """Every hybrid controller in both forms, then every impedance; each in every representation that it takes."""
    along = [one for one in known_representations().values() if one.about is not None]
    found = []
    for law in HYBRIDS:
        for one in (None,) if law in ALONG_AXES else along:
            found += [hybrid(law, form, one) for form in FORMS]
    for impedance in known_impedances().values():
        found += [springy(impedance, one) for one in (along if impedance.law_in else (None,))]
    return found


def find_compliant(word: str) -> Compliant:
    """`law[/representation][+form]`, as the command line writes a controller in contact.

    Errors:
        UnknownWord: of the law or the representation. Incompatible: a part too many, too few, or unfitting.
    """
    rest, plus, form = word.partition("+")
    law, _, coordinates = rest.partition("/")
    springs = {f"impedance-{name}": one for name, one in known_impedances().items()}
    if law not in (*HYBRIDS, *springs):
        raise UnknownWord("controller", law, sorted((*HYBRIDS, *springs)))
    along = representation(coordinates) if coordinates else None
    if law in HYBRIDS:
        one = hybrid(law, form or FORMS[0], along)
        if not form:
            raise Incompatible(f"'{word}' lacks its way to the joints (try: {rest}+inverse, or {rest}+projected)")
        return one
    if plus:
        raise Incompatible(f"'{word}': an impedance has one way to the joints (leave '+{form}' away)")
    return springy(springs[law], along)


def load_law(path: Path, text: bytes | None = None) -> Regulator:
    """The REGULATOR of a file outside the package. This runs the file.

    The module's name carries a digest of the file, so that nothing of an earlier version is ever reused.

    Args:
        text: what the file holds, if it has been read already.

    Errors:
        BadLaw: the file is missing, does not import, lacks REGULATOR, or its law does not return three numbers.
    """
    path = Path(path)
    if not path.is_file():
        raise BadLaw(f"--law {path}: there is no such file; give the path of a Python file with a constant REGULATOR")
    try:
        text = path.read_bytes() if text is None else text
    except OSError as error:
        raise BadLaw(f"--law {path}: it cannot be read ({error.strerror}); mend its rights") from error
    name = f"user_law_{path.stem}_{hashlib.sha256(text).hexdigest()[:12]}"
    module = types.ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module
    try:
        exec(compile(text, path, "exec"), module.__dict__)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise BadLaw(f"--law {path}: it does not import ({type(error).__name__}: {error}); mend the file") from error
    own = getattr(module, "REGULATOR", None)
    if not isinstance(own, Regulator):
        given = "no REGULATOR" if own is None else f"a REGULATOR of type {type(own).__name__}"
        raise BadLaw(
            f"--law {path}: it has {given}; it needs a constant REGULATOR = bench.contender.Regulator(...) (see README)"
        )
    _check_fields(own, path)
    if own.name in known_regulators():
        raise BadLaw(f"--law {path}: the name '{own.name}' is one of ours; give your REGULATOR another name")
    own = own._replace(origin=str(path))
    for one in contenders_of(own):
        _check_shape(one, path)
    return own


TRIAL = Rotation((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6))
"""A rotation with short decimals, away from every singular set we know: where a law is tried once."""


def _check_fields(own: Regulator, path: Path) -> None:
    """What the fields of a user's REGULATOR must be, before anything is made of them."""
    on_matrix = own.coordinates == "rotation-matrix"
    needed = "law" if on_matrix else "law_in"
    memory = own.memory or ()
    coordinates = own.coordinates if isinstance(own.coordinates, tuple) else ()
    problems = (
        (
            not (isinstance(own.name, str) and WORD.fullmatch(own.name)),
            f"its name {own.name!r} is no word of a-z, 0-9 and dashes, such as 'my-law'",
        ),
        (
            not all(isinstance(text, str) for text in (own.title, own.source, own.formula, own.property)),
            "title, source, formula and property must be texts",
        ),
        (
            not (on_matrix or own.coordinates == "any" or coordinates),
            f"its coordinates are {own.coordinates!r}; allowed: 'rotation-matrix', 'any', a tuple of names",
        ),
        (
            not callable(getattr(own, needed)),
            f"its {needed} is {_shown(getattr(own, needed))}; on {own.coordinates!r} coordinates give a function",
        ),
        (
            not (
                isinstance(memory, tuple)
                and len(memory) <= len(NO_MEMORY)
                and all(isinstance(x, float) for x in memory)
            ),
            f"its memory is {own.memory!r}; give None or a tuple of up to {len(NO_MEMORY)} floats",
        ),
        (own.in_engine is not False, "it has in_engine; MuJoCo's own actuator would run in its place: leave it away"),
    )
    for is_wrong, problem in problems:
        if is_wrong:
            raise BadLaw(f"--law {path}: {problem}")
    for word in coordinates:
        representation(word)


MISTAKES = (TypeError, NameError, AttributeError, ImportError)
"""What a law raises that was written wrongly; anything else it may raise in some state, and that is a row."""


def _check_shape(one: Contender, path: Path) -> None:
    first = one.regulator.memory
    has_memory = first is not None
    memory = () if first is None else ((*first, *NO_MEMORY[len(first) :]),)
    try:
        answer = one.law(TRIAL, (0.1, 0.2, 0.3), Goal(), Gains(), *memory)
    except MISTAKES as error:
        arguments = "R, omega, goal, gains, memory" if has_memory else "R, omega, goal, gains"
        raise BadLaw(
            f"--law {path}: the law of '{one.name}' cannot be called as law({arguments}) "
            f"({type(error).__name__}: {error}); see the example in README"
        ) from error
    except Exception:
        return  # a law that raises in an episode is a row, not a mistake of the caller
    if has_memory:
        if not (
            isinstance(answer, tuple) and len(answer) == 2 and isinstance(answer[1], tuple) and len(answer[1]) == 4
        ):
            raise BadLaw(
                f"--law {path}: the law of '{one.name}' has memory and returned {_shown(answer)}; it must return "
                "(command, memory) with a memory of four floats"
            )
        answer = answer[0]
    if not (isinstance(answer, tuple) and len(answer) == 3 and all(isinstance(x, float) for x in answer)):
        raise BadLaw(
            f"--law {path}: the law of '{one.name}' returned {_shown(answer)}; it must return a tuple of three floats, "
            "the angular acceleration in the base frame"
        )


def _shown(answer) -> str:
    text = repr(answer)
    return text if len(text) <= 60 else text[:57] + "..."

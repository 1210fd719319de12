"""In which order units run: so that what one thread compiles, no other waits for."""

from collections.abc import Iterable

from bench.experiments.experiment import Unit, experiment_of


def in_running_order(units: Iterable[Unit]) -> list[Unit]:
    """Contender by contender; the first unit of each before the rest of the one before it; what compiles nothing last.

    A contender is compiled when its first unit runs, by one thread at a time: so the others have something to run.
    """
    units = list(units)
    compiling = [unit for unit in units if experiment_of(unit).compiles]
    place = {name: i for i, name in enumerate(dict.fromkeys(unit.contender for unit in compiling))}
    heads = set({unit.contender: unit for unit in reversed(compiling)}.values())
    ordered = sorted(compiling, key=lambda unit: (place[unit.contender] - (unit in heads), unit not in heads))
    return ordered + [unit for unit in units if not experiment_of(unit).compiles]

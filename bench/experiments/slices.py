"""Slices of a suite: an engine on a start set, as a unit that has no experiment and no contender yet.

`total` is the number of starts; 0 stands for the start set's own number. `episodes` completes slices and cuts them.
"""

from collections.abc import Iterable, Mapping

from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.suites import HORIZON, LISTS, NOMINAL, ON_ARM, SHORT


def slice_of(engine: str, start_set: str, size: int | None, horizon_s: float) -> Unit:
    """Return an engine on so many starts of a set; None is the set's own number."""
    return Unit("", engine=engine, selector=start_set, variation=NOMINAL, total=size or 0, horizon_s=horizon_s)


def read_slices(declared: Iterable[tuple]) -> tuple[Unit, ...]:
    """Return the slices of engines on uniform starts, if there are some, and on the directed sets."""
    found = []
    for engine, uniform, *directed in declared:
        if uniform:
            found.append(slice_of(engine, "uniform", uniform, SHORT))
        for name in directed[0] if directed else LISTS["DIRECTED"]:
            found.append(slice_of(engine, name, None, HORIZON.get(name, SHORT)))
    return tuple(found)


def read_on_arms(sizes: Mapping[str, int | None], horizon_s: float = ON_ARM) -> tuple[Unit, ...]:
    """Return the slices of an arm from the number of starts of each set."""
    return tuple(slice_of("native", name, size, horizon_s) for name, size in sizes.items())


def narrow(slices: tuple[Unit, ...], request: Request) -> tuple[Unit, ...]:
    """Return slices of the engines and start sets that are named, in the suite's numbers where it has them."""
    if not request.changes_starts_or_engines:
        return slices
    by_place = {(part.engine, part.selector): part for part in slices}
    engines = request.engines or tuple(dict.fromkeys(part.engine for part in slices))
    start_sets = request.start_sets or tuple(dict.fromkeys(part.selector for part in slices))
    on_arms = {part.selector for part in slices if part.horizon_s == ON_ARM}
    found = []
    for engine in engines:
        for name in start_sets:
            part = by_place.get((engine, name))
            # The reference engine is slow: unless it is named, it runs what the suite has alone.
            if part is None and engine == "reference" and not request.engines:
                continue
            horizon_s = ON_ARM if name in on_arms else HORIZON.get(name, SHORT)
            found.append(part or slice_of(engine, name, None, horizon_s))
    return tuple(found)

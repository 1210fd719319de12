"""Options that several commands share."""

from pathlib import Path

import rich_click as click

from bench import discovery
from bench.contender import Contender, Regulator
from bench.schema import RESULTS

LATEST = RESULTS / "latest"
REFERENCE = RESULTS / "reference"

law = click.option(
    "--law",
    "laws",
    multiple=True,
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="A file of your own with a constant REGULATOR; repeatable.",
)
regulator = click.option(
    "--regulator",
    "regulators",
    multiple=True,
    metavar="NAME",
    help="Only this law: NAME or NAME/REPRESENTATION; repeatable.",
)
representation = click.option(
    "--representation",
    "representations",
    multiple=True,
    metavar="NAME",
    help="Only laws on these coordinates; repeatable.",
)


def own_laws(files: tuple[Path, ...]) -> tuple[Regulator, ...]:
    """The user's regulators; two of one name are refused."""
    own = tuple(discovery.load_law(path) for path in files)
    names = [one.name for one in own]
    for name in names:
        if names.count(name) > 1:
            raise click.UsageError(f"two --law files name their regulator '{name}'; give each its own name")
    return own


def chosen(files, regulators, representations, costings: bool = False) -> list[Contender]:
    """The contenders that the options name; without names, all (the user's own included)."""
    own = own_laws(files)
    if regulators:
        picked = [one for word in regulators for one in _named(word, own)]
        named = {one.regulator.name for one in picked}
        picked += [one for law in own if law.name not in named for one in discovery.contenders_of(law)]
    else:
        picked = [one for one in discovery.all_contenders(own) if costings or not one.regulator.costing_only]
    for word in representations:
        discovery.representation(word)
    if representations:
        picked = [one for one in picked if one.representation and one.representation.name in representations]
        if not picked:
            raise click.UsageError(
                f"no chosen law acts on {', '.join(representations)} (try: python -m bench list regulators)"
            )
    return list(dict.fromkeys(picked))


def _named(word: str, own) -> list[Contender]:
    if "/" in word:
        return [discovery.find_contender(word, own)]
    return discovery.contenders_of(discovery.regulator(word, own))

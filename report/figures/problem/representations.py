"""What the page on coordinates shows: what there is, and what of Z-Y-X angles is left near a pole."""

from __future__ import annotations

import functools
import math
import sys

from bench.contenders.registry import known_representations
from report.figures.kit.page import Run
from report.figures.kit.spelling import power, prose
from report.figures.kit.tables import Table
from report.figures.problem import conditioning, extraction

COORDINATES = Table("Coordinates | Definition | Where it breaks | Source")
extracted = functools.cache(extraction.errors)


def facts(_: Run) -> dict:
    """How far each way to take angles off a matrix is off; how fast angles move near a pole."""
    found = extracted()
    worst = found.groupby("way")["error"].max()
    return {
        **{f"worst_{way}": power(float(worst[way])) for way in extraction.WAYS},
        "orientations": 2 * extraction.PAIRS,
        "scipy_jump": power(extraction.jump(found)),
        "gain": f"{gain(0.5):.0f}",
    }


def tables(_: Run) -> dict:
    """Every representation there is."""
    coordinates = [
        (one.title, f"${one.formula}$", prose(where_it_breaks(one)), one.source)
        for one in known_representations().values()
    ]
    return {"representations": COORDINATES(coordinates)}


def figures(_: Run) -> dict:
    """Draw where each map of rates loses rank."""
    return {"conditioning": conditioning.conditioning()}


def where_it_breaks(one) -> str:
    """What the module's docstring says after its first paragraph."""
    text = sys.modules[one.chart.__module__].__doc__ or ""
    return " ".join(text.partition("\n\n")[2].split())


def gain(short_deg: float) -> float:
    """Largest |Edot| that a unit of |omega| can mean this far from a pole: 1 / sqrt(1 - |sin beta|)."""
    return 1.0 / math.sqrt(1.0 - math.cos(math.radians(short_deg)))

"""The map of advice as a picture that the reader changes: report/_extra/advice.js draws it."""

import html as markup
import json
import math
from typing import Any

from bench.findings.selection.regions import decide_all, find_regions, read_map
from bench.findings.selection.sensitivity import RULES
from report.figures.kit import families, html, style
from report.figures.kit.page import Run
from tasks.situation import COORDINATES, NOMINAL, Situation

SHOWN = ("the rule", "noise is left out", "no memory", "a continuous command", "times within 10 % are equal")
"""Rules that the reader may choose from."""


def facts(_: Run) -> dict[str, Any]:
    """Return the picture."""
    names = families.in_order(read_map()["contender"].astype(str))
    planes = {name: plane(name, names) for name in list(COORDINATES)[1:]}
    data = {
        "laws": _colour(names),
        "rules": SHOWN,
        "zetas": [[COORDINATES["zeta"].scale(level), f"{level:g}"] for level in COORDINATES["zeta"].levels],
        "planes": planes,
    }
    inside = json.dumps(data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
    options = {name: COORDINATES[name].title for name in planes}
    return {
        "advice-map": html.Html(
            f'<div class="advice-choices">{_select("plane", "Second number", options)}'
            f"{_select('rule', 'Asked', dict(zip(SHOWN, SHOWN, strict=True)))}</div>"
            '<canvas id="advice-map" tabindex="0" role="img" aria-label="The advised law over the damping ratio and a '
            'second number; the tables below have the same regions"></canvas>'
            '<p id="advice-keys" class="advice-keys"></p><p id="advice-said" class="hint" role="status"></p>'
            f'<script type="application/json" id="advice-data">{inside}</script>'
        )
    }


def plane(name: str, laws: list[str]) -> dict[str, Any]:
    """Return the situations of the plane of the damping ratio and another number, each with its verdicts by SHOWN."""
    one = COORDINATES[name]
    nominal = {"zeta": NOMINAL.zeta, name: getattr(NOMINAL, name)}
    every = [at for at in decide_all() if at._replace(**nominal) == NOMINAL]
    return {
        "top": max(one.scale(level) for level in one.levels),
        "ticks": [[one.scale(level), "none" if math.isinf(level) else f"{level:g}"] for level in one.levels],
        "points": [_point(at, name, laws) for at in every],
    }


def _point(at: Situation, name: str, laws: list[str]) -> dict[str, Any]:
    return {
        "x": round(COORDINATES["zeta"].scale(at.zeta), 4),
        "y": round(COORDINATES[name].scale(getattr(at, name)), 4),
        "words": at.describe(),
        "verdicts": [_verdict(at, rule, laws) for rule in SHOWN],
    }


def _verdict(at: Situation, words: str, laws: list[str]) -> dict[str, Any]:
    one = decide_all(rule=RULES[words])[at]
    if one.law is None:
        return {"law": -1, "tied": [], "ours": [], "faster": False, "time": ""}
    rows = read_map()
    time = rows.loc[(rows["situation"] == at.word) & (rows["contender"] == one.law), "time"].iloc[0]
    return {
        "law": laws.index(one.law),
        "tied": [laws.index(law) for law in one.tied],
        "ours": [laws.index(law) for law in one.ours],
        "faster": bool(one.faster),
        "time": f"{time:.2f}",
    }


def _colour(names: list[str]) -> list[dict[str, Any]]:
    """Return the laws' names and colours: a law's own, or another where a law that is advised has it already."""
    advised = [one.law for words in SHOWN for one in find_regions(rule=RULES[words])]
    taken: dict[str, str] = {}
    for law in dict.fromkeys(advised):
        own = style.look(law).colour
        taken[law] = next((one for one in (own, *style.COLOURS.values()) if one not in taken.values()), own)
    colours = [taken.get(name, style.look(name).colour) for name in names]
    return [
        {"name": families.word(name), "colour": [one, style.TWINS[one]]}
        for name, one in zip(names, colours, strict=True)
    ]


def _select(word: str, label: str, options: dict[str, str]) -> str:
    inside = "".join(
        f'<option value="{markup.escape(key)}">{markup.escape(text)}</option>' for key, text in options.items()
    )
    return f'<label>{label} <select id="advice-{word}">{inside}</select></label>'

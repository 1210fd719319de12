"""Two laws from one start: the controls of the live page, its starts and laws; report/_extra/live.js runs them.

The laws, the plant and the judge are those that are measured, translated (`bench.export.browser`).
"""

import html as markup
import itertools
import json
import math
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import tasks
from bench.base.errors import BadLaw
from bench.experiments.tables.run import FREE_BODY, Run
from bench.export import browser
from bench.law.contender import Contender
from bench.law.contenders.registry import simulated_contenders
from report.figures.cost.cost import CALLS
from report.figures.kit import families, html, laws, media, style
from tasks.base import Start
from tasks.rules import RULES
from tasks.truth import angle

CONTROLS = Path(__file__).with_name("live.html")

OFFERED = tomllib.loads(Path(__file__).with_name("live.toml").read_text(encoding="utf-8"))
OPENING, PRESETS = OFFERED["opening"], OFFERED["presets"]
"""What the page shows first: the paper's first law near 180°, and the law that is advised."""

STILLS = ("stuck", "unwinding", "sensor-off", "gimbal-lock")
"""Presets whose pictures stand for the page where no script runs, and on paper (report/stills.py)."""


def starts() -> list[tuple[str, str, Start]]:
    """(group, title, start) of each."""
    found = []
    for name, group, start_id, title in OFFERED["starts"]["every"]:
        [one] = [start for start in tasks.start_set(name) if start.id == start_id]
        turn, speed = degrees(angle(one.quat_wxyz, one.goal_wxyz)), f"{math.hypot(*one.omega):.0f} rad/s"
        found.append((group, title.format(angle=turn, speed=speed), one))
    return found


def page(contenders: list[Contender], costs: Any) -> html.Html:
    """Return controls, hidden until the script is there, the laws' code, and what it reads; costs: on the free body."""
    names, every = [one.on_free_body for one in contenders], starts()
    inside = json.dumps(data(names, every, costs), separators=(",", ":")).replace("<", "\\u003c")
    presets = presets_of(names)
    buttons = "".join(
        f'<li><button type="button" data-preset="{word}">{one["title"]}</button></li>\n'
        for word, one in presets.items()
    )
    texts = {"anchors": "".join(f'<span id="{word}"></span>' for word in presets), "presets": buttons}
    groups = [(one.title, [(name, families.word(name)) for name in one.laws]) for one in families.present(names)]
    options = {side: _options(groups, OPENING[side]) for side in "ab"}
    kinds = itertools.groupby(every, lambda one: one[0])
    options["starts"] = _options(
        ((kind, ((one.id, title) for _, title, one in own)) for kind, own in kinds), OPENING["start"]
    )
    controls = CONTROLS.read_text(encoding="utf-8").format(band=f"{RULES.tolerance:.0%}", **texts, **options)
    stills = "".join(still(word) for word in STILLS)
    return html.Html(
        f'{controls}<script type="application/json" id="live-data">{inside}</script>'
        f'<script id="live-laws">\n{browser.script(contenders)}</script>'
        f"<noscript><p>{WITHOUT_SCRIPT}</p></noscript>"
        f'<div class="live-stills">{stills}</div>{HIDE_STILLS}'
    )


WITHOUT_SCRIPT = "This page needs JavaScript, because it runs the laws in the browser. The pictures show four examples."

HIDE_STILLS = '<script>document.documentElement.classList.add("has-script")</script>'
"""Before they are loaded, where a script runs."""


def still(word: str) -> str:
    """Return the picture of a preset, with what the page says of it as its alternative text."""
    said = json.loads((media.FOLDER / "live.json").read_text(encoding="utf-8"))[word]
    preset, alt = PRESETS[word], markup.escape(" ".join(said))
    picture = f'<img src="{media.SOURCE}/live-{word}.png" alt="{alt}" loading="lazy">'
    title = f'<span class="caption-number">{preset["title"]}.</span>'
    return f"<figure>{picture}<figcaption>{title} {preset['watch']}</figcaption></figure>"


def data(names: list[str], every: list[tuple[str, str, Start]], costs: Any) -> dict:
    """All that the script reads."""
    return {
        "opening": OPENING,
        "presets": presets_of(names),
        "rules": {**RULES._asdict(), "slow_squared": RULES.slow_squared},
        # where both laws have one colour, B takes the first of these that A has not
        "neutrals": [[one, style.TWINS[one]] for one in (style.INK, style.REST)],
        "laws": {name: law(name, costs) for name in families.in_order(names)},
        "starts": [{"id": one.id, "q": one.quat_wxyz, "omega": one.omega, "goal": one.goal_wxyz} for *_, one in every],
    }


def presets_of(names: list[str]) -> dict[str, dict[str, str]]:
    """Return the presets of these laws, by the names that are their addresses."""
    return {word: one for word, one in PRESETS.items() if {one["a"], one["b"]} <= set(names)}


def law(name: str, costs: Any) -> dict:
    """How a law is called and drawn, where its card is, and what a tick of it costs."""
    look = style.look(name)
    return {
        "name": families.word(name),
        "title": laws.title(name),
        "card": f"{families.PAGES}/{families.anchor(name)}.html",
        "colour": [look.colour, style.TWINS[look.colour]],
        "cost": cost(name, costs),
    }


def cost(name: str, costs: Any) -> str:
    """Operations a tick in words, where they differ also the worst branch."""
    totals = costs[(costs["contender"] == name) & (costs["stage"] == "total")].set_index("branch")
    if totals.empty:
        return html.MISSING
    said = {}
    for branch in ("typical", "worst"):
        calls = int(totals.loc[branch, list(CALLS)].sum())
        said[branch] = f"{int(totals.at[branch, 'flops'])} flops, {calls} {'call' if calls == 1 else 'calls'}"
    return said["typical"] if said["typical"] == said["worst"] else f"{said['typical']}; at most {said['worst']}"


def _options(groups: Iterable[tuple[str, Iterable[tuple[str, str]]]], chosen: str) -> str:
    """Return options in groups: (title, (value, text) of each)."""
    found = ""
    for title, options in groups:
        found += f'<optgroup label="{markup.escape(title)}">'
        for value, text in options:
            mark = " selected" if value == chosen else ""
            found += f'<option value="{markup.escape(value)}"{mark}>{markup.escape(text)}</option>'
        found += "</optgroup>"
    return found


def degrees(angle_rad: float) -> str:
    """Return an angle in degrees, with as many decimals as tell it from half a turn."""
    angle = math.degrees(angle_rad)
    short = abs(180.0 - angle)
    decimals = max(0, math.ceil(-math.log10(short))) if short > 1e-9 else 0
    return f"{angle:.{decimals}f}°"


def alive(names: Iterable[str]) -> list[Contender]:
    """Ours, and of the other laws of these names those that can be translated."""
    ours = simulated_contenders()
    known = {one.on_free_body for one in ours}
    return [*ours, *filter(None, (_translatable(name) for name in sorted(set(names) - known)))]


def _translatable(name: str) -> Contender | None:
    found = laws.contender(name)
    if found is None or found.baseline is not None or found.regulator.costing_only:
        return None
    try:
        browser.script([found])
    except BadLaw:
        return None
    return found


def facts(run: Run) -> dict:
    """Return the numbers of the text, and what the script brings to life."""
    ours, costs = alive(()), run.any_rows("costs", **FREE_BODY)
    return {
        "laws": len(ours),
        "kilobytes": f"{len(browser.script(ours)) / 1000:.0f}",
        "two-laws": page(alive(costs["contender"].astype(str)), costs),
    }

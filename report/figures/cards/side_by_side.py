"""Two laws from one start: the controls of the page, which report/_extra/side-by-side.js brings to life.

Without a script there stands how every law ends from every start, as a table.
"""

from __future__ import annotations

import functools
import html as markup
import itertools
import json
from collections.abc import Iterable

import pandas as pd

from bench.experiments.traces import EVERY_S, LONGEST_S
from bench.tables import read
from report.figures.cards.side_by_side_data import Start, data, shown, starts
from report.figures.comparison.comparison import ideal
from report.figures.kit import families, html
from report.figures.kit.page import Run, given
from tasks.rules import RULES

OPENING = {"a": "rotation-matrix", "b": "feedback-linearized/zyx-euler", "start": "figure-2.5"}
"""What the page shows first: the shortest way and a long one."""

PRESETS = (
    ("Near half a turn", "rotation-matrix", "quaternion-shortest", "half-turn-random0-k02"),
    ("Exactly half a turn", "rotation-matrix", "late-braking", "half-turn-random0-exact"),
    ("A sign forgotten", "quaternion-shortest", "quaternion-unwinding", "goal-beyond-wrap-gamma-up"),
    ("Across a jump of the angles", "rotation-vector", "feedback-linearized/zyx-euler", "goal-beyond-wrap-gamma-up"),
    ("Beside a pole", "linearized-euler/zyx-euler", "euler-gradient/zyx-euler", "pole-plus-k02-a2.5-g2.8"),
    ("Spinning", "feedback-linearized/zyx-euler", "mrp", "tumbling-0006"),
)
"""Title, laws A and B, start: one click each."""


@functools.cache
def followed(run: Run) -> pd.DataFrame:
    """Traces of every law from every telling start."""
    return shown(run.rows("traces", task="free-body"))


def page(rows: pd.DataFrame, episodes: pd.DataFrame, costs: pd.DataFrame) -> html.Html:
    """Controls and empty drawings, hidden until the script is there, and the data.

    Args:
        as of `side_by_side_data.data`.
    """
    inside = json.dumps(data(rows, episodes, costs), separators=(",", ":")).replace("<", "\\u003c")
    given = {"starts": _start_options(starts(rows, episodes)), "band": f"{RULES.tolerance:.0%}".replace("%", " %")}
    given["presets"] = "\n".join(
        f'<button type="button" data-view="a={a}&amp;b={b}&amp;start={start}">{title}</button>'
        for title, a, b, start in PRESETS
    )
    given |= {side: _law_options(rows["contender"].unique(), OPENING[side]) for side in "ab"}
    return html.Html(
        f'{CONTROLS.format(**given)}<script type="application/json" id="side-data">{inside}</script>'
        "<noscript><p>Choosing needs JavaScript. Below, without it: how every law ends.</p></noscript>"
    )


CONTROLS = """
<section id="side-by-side" class="side" aria-label="Two laws from one start" hidden>
<div class="side-choices">
<p><label for="side-a"><span class="side-key a"></span>Law A</label><select id="side-a">{a}</select></p>
<p><label for="side-b"><span class="side-key b"></span>Law B</label><select id="side-b">{b}</select></p>
<p class="side-start"><label for="side-start">Start</label><span class="side-row">
<button type="button" id="side-previous" aria-label="Previous start">‹</button>
<select id="side-start">{starts}</select>
<button type="button" id="side-next" aria-label="Next start">›</button></span></p>
</div>
<p class="side-presets"><span>Worth a look:</span> {presets}</p>
<p id="side-said" class="side-said" role="status"></p>
<div class="side-views">
<div class="side-plots">
<p class="side-title">Angle to the goal [deg]
<label class="side-check"><input type="checkbox" id="side-log"> logarithmic</label></p>
<svg id="side-angle" role="img" aria-label="Angle to the goal against time, of both laws"></svg>
<p class="side-title">Size of the command [rad/s²]</p>
<svg id="side-command" role="img" aria-label="Size of the command against time, of both laws"></svg>
<p class="hint">Ring: settled, from there on below the dotted line, {band} of the first angle.
Cross: the run breaks off. It plays at half speed.</p>
</div>
<div class="side-turns">
<p class="side-title">Way through the ball of rotations</p>
<canvas id="side-ball" class="ball" tabindex="0" role="img"
 aria-label="The ball of rotation vectors, with the ways of both laws to its centre, the goal"></canvas>
<p class="hint">From the start to the cross, the goal. Distance from it is the angle, direction the axis; the surface is
half a turn, where a way leaves and goes on at the opposite point. Drag, or use the arrow keys, to turn.</p>
</div>
</div>
<div class="side-clock">
<button type="button" id="side-play">Play</button>
<label for="side-time">Time</label><input type="range" id="side-time" aria-label="Time" min="0" step="0.02" value="0">
<output id="side-now" for="side-time"></output>
</div>
<table class="plain side-facts">
<thead><tr><th scope="col">Law</th><th scope="col" class="a"></th><th scope="col" class="b"></th></tr></thead>
<tbody></tbody>
</table>
</section>
"""


def _law_options(names: Iterable[str], chosen: str) -> str:
    """Laws by family."""
    return "".join(
        _group(one.title, ((name, families.word(name)) for name in one.laws), chosen) for one in families.present(names)
    )


def _start_options(found: list[Start]) -> str:
    """Starts by kind."""
    return "".join(
        _group(title, ((one.id, one.title) for one in own), OPENING["start"])
        for title, own in itertools.groupby(found, lambda one: one.group)
    )


def _group(title: str, options: Iterable[tuple[str, str]], chosen: str) -> str:
    inside = "".join(
        f'<option value="{markup.escape(value)}"{" selected" if value == chosen else ""}>{markup.escape(text)}</option>'
        for value, text in options
    )
    return f'<optgroup label="{markup.escape(title)}">{inside}</optgroup>'


def facts(run: Run) -> dict:
    """Numbers of the page's text."""
    episodes = ideal(run)
    return {
        "kp": float(episodes["kp"].iloc[0]),
        "kv": float(episodes["kv"].iloc[0]),
        "every_ms": f"{1000 * EVERY_S:g}",
        "longest_s": f"{LONGEST_S:g}",
        "horizon_s": f"{episodes['horizon_s'].max():g}",
    }


def tables(run: Run) -> dict:
    """How every law ends from every start."""
    return {"ends": given(followed(run), lambda rows: table(rows, ideal(run)))}


def figures(run: Run) -> dict:
    """What the script brings to life."""
    costs = run.rows("costs", **read.FREE_BODY)
    return {"two-laws": given(followed(run), lambda rows: page(rows, ideal(run), costs))}


def table(rows: pd.DataFrame, episodes: pd.DataFrame) -> html.Markdown:
    """A row a law, a column a start: settling time [s], or the outcome."""
    ends = rows.drop_duplicates(["contender", "start_id"]).set_index(["contender", "start_id"])
    times = ends["settling_time_s"].map("{:.2f}".format)
    ends = ends.assign(end=times.where(ends["outcome"] == "settled", ends["outcome"].astype(str)))
    lines = [
        {"Law": families.link(name, families.word(name))}
        | {one.short: ends.at[(name, one.id), "end"] for one in starts(rows, episodes)}
        for name in families.in_order(rows["contender"].unique())
    ]
    return html.table(pd.DataFrame(lines))

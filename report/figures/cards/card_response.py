"""The small response of a law's card: the angle to the goal over time, from a few starts that tell laws apart.

Written as SVG by hand: two dozen cards stand on one page, and drawing each would take longer than all else on it. Its
colours and letters are the page's own (`.card-response` in report/_static/report.css).
"""

from __future__ import annotations

import html
import math

import pandas as pd

from report.figures.kit.inline import Picture

SHOWN = {"figure-2.3": "", "figure-2.5": "6 3", "figure-2.4": "8 3 2 3", "half-turn-random0-k04": "2 3"}
"""The paper's three starts, and one short of a half turn by 0.006 degrees; each with the dashes of its line."""

SHOWN_S, TOP_DEG = 2.0, 190.0
LEFT, RIGHT, ABOVE, BELOW = 38.0, 292.0, 6.0, 122.0
"""Of the panel, in a picture of 300 by 158."""

TIMES, ANGLES = (0.0, 0.5, 1.0, 1.5, 2.0), (0, 90, 180)


def card_response(traces: pd.DataFrame, title: str) -> Picture:
    """Curves of one law; a start that the run did not follow is left out.

    Args:
        traces: rows of one law and engine.
    """
    curves, said = [], []
    for start_id, dashes in SHOWN.items():
        own = traces[(traces["start_id"] == start_id) & (traces["time_s"] <= SHOWN_S)]
        if len(own):
            times, angles = own["time_s"].to_numpy(), own["angle_rad"].to_numpy() * 180.0 / math.pi
            points = " ".join(f"{across(t):.1f},{up(a):.1f}" for t, a in zip(times, angles, strict=True))
            curves.append(f'<polyline points="{points}" stroke-dasharray="{dashes}"/>')
            said.append(f"{angles[0]:.0f} at first, {angles[-1]:.2g} at {times[-1]:.1f} s")
    words = f"{title}: angle to the goal in degrees from {len(said)} starts: {'; '.join(said)}."
    alt = html.escape(words, quote=True)
    opening = f'<svg class="card-response" viewBox="0 0 300 158" role="img" aria-label="{alt}">'
    return Picture(f"{opening}{axes()}{''.join(curves)}</svg>", words)


def axes() -> str:
    """Two axes with their ticks and names."""
    lines = [f'<path d="M{LEFT} {ABOVE}V{BELOW}H{RIGHT}"/>']
    lines += [f'<text x="{across(t)}" y="{BELOW + 14}" text-anchor="middle">{t:g}</text>' for t in TIMES]
    lines += [f'<text x="{LEFT - 5}" y="{up(a) + 4:.1f}" text-anchor="end">{a}°</text>' for a in ANGLES]
    name = "angle to the goal over time [s]"
    lines.append(f'<text x="{(LEFT + RIGHT) / 2.0}" y="{BELOW + 31}" text-anchor="middle">{name}</text>')
    return "".join(lines)


def across(time: float) -> float:
    """A time's place."""
    return LEFT + (RIGHT - LEFT) * time / SHOWN_S


def up(angle: float) -> float:
    """An angle's place."""
    return BELOW - (BELOW - ABOVE) * angle / TOP_DEG

"""The failing starts of all three laws in the ball of rotation vectors, to be turned by the reader.

A point is an orientation: its direction is the axis of rotation, its distance from the centre the angle, pi at the
surface, where opposite points are one orientation and both are drawn.
"""

import math

import numpy as np
import pandas as pd

from bench.findings.start_sets import AT_REST
from report.figures.kit import html, laws, style

ON_SURFACE = 1e-9
"""rad from pi: closer than any place on a screen."""

DIGITS = 3


def ball(episodes: pd.DataFrame, name: str = "failures") -> html.Html:
    """Return the ball of one engine's failing starts, a colour for each law, whatever its outcome."""
    at_rest = episodes[episodes["start_set"].isin(("uniform", *AT_REST))]
    groups, said = {}, []
    for contender, title, rows in laws.each(at_rest):
        failed = rows[rows["outcome"] != "settled"]
        look = style.look(contender)
        groups[title] = {"colour": look.colour, "dark": look.dark, "xyz": unit_ball(failed)}
        said.append(f"{title} {html.number(len(failed))} of {html.number(len(rows))}")
    alt = f"The ball of all orientations with the starts that fail to settle: {'; '.join(said)}."
    return html.ball(name, alt, groups)


def unit_ball(rows: pd.DataFrame) -> list[list[float]]:
    """Rotation vectors over pi of the starts, each orientation once, 180° rotations at both ends of their axis."""
    quat = rows[["quat_w", "quat_x", "quat_y", "quat_z"]].to_numpy()
    quat = quat * np.where(quat[:, :1] < 0.0, -1.0, 1.0)
    length = np.linalg.norm(quat[:, 1:], axis=1)
    angle = 2.0 * np.arctan2(length, quat[:, 0])
    points = quat[:, 1:] * (angle / math.pi / np.where(length > 0.0, length, 1.0))[:, None]
    surface = points[angle > math.pi - ON_SURFACE]
    every = np.unique(np.round(np.vstack((points, -surface)), DIGITS), axis=0)
    return (every + 0.0).tolist()

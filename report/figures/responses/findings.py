"""The numbers in the sentences of the pages: each function gives what one page pastes, key by key."""

import numpy as np
import pandas as pd

from report.figures.failures.failure_tables import EXACT_RAD
from report.figures.kit import html
from report.figures.kit.rows import FEEDBACK, LINEARIZED, MATRIX, SHORT, lost, of
from report.figures.kit.share import share
from report.figures.responses import responses, settling_decades

CALLS = ["sin", "cos", "atan2", "acos"]


def glue_all(values: dict) -> None:
    """Make every number available to the page's text under its key."""
    from myst_nb import glue

    for key, value in values.items():
        glue(key, html.cell(value), display=False)


def exact_half_turns(episodes: pd.DataFrame) -> pd.DataFrame:
    """The rotation-matrix law's starts exactly on a half turn."""
    half = of(episodes, MATRIX, "half-turn")
    return half[settling_decades.decade(half["start_id"]).isna()]


def front(episodes: pd.DataFrame, costs: pd.DataFrame) -> dict:
    """Of the front page; episodes of one engine, costs of the typical branch in total."""
    poles = of(episodes, FEEDBACK, "poles")
    on_pole = poles[np.pi / 2.0 - poles["beta0"].abs() < EXACT_RAD]
    exact, tallies = exact_half_turns(episodes), costs.set_index("contender")
    values = {
        "slope": f"{settling_decades.slope(of(episodes, MATRIX, 'half-turn')):.3f}",
        "stuck": len(lost(exact)),
        "exact": len(exact),
        "least": f"{np.degrees(lost(of(episodes, LINEARIZED))['alpha0'].abs().min()):.0f}",
        "polar": len(lost(on_pole)),
        "on_pole": len(on_pole),
    }
    for letter, name in SHORT.items():
        rows = of(episodes, name)
        found = share(len(rows) - len(lost(rows)), len(rows))
        interval = f"{100 * found.low:.1f} to {100 * found.high:.1f} %"
        values[f"share_{letter}"] = f"{100 * found.value:.1f} % ({interval}, n = {html.number(found.n)})"
        values[f"slowest_{letter}"] = f"{rows['settling_time_s'].max():.2f}"
        values[f"flops_{letter}"] = int(tallies.loc[name, "flops"])
        values[f"calls_{letter}"] = int(tallies.loc[name, CALLS].sum())
    return values


def responding(traces: pd.DataFrame, episodes: pd.DataFrame, figures: tuple[str, ...]) -> dict:
    """Of the responses; both tables hold one engine's starts of the set paper."""
    kp, kv = float(episodes["kp"].iloc[0]), float(episodes["kv"].iloc[0])
    drawn = episodes[episodes["contender"].isin(SHORT.values())]
    values: dict = {"kp": kp, "kv": kv, "drawn": len(drawn), "good": len(drawn) - len(lost(drawn))}
    for figure in figures:
        start, end = f"figure-{figure}", figure[-1]
        bends = responses.bends_deg(traces, start, kp, kv).set_index("contender")
        rows = drawn[drawn["start_id"] == start].set_index("contender")
        for letter, name in SHORT.items():
            values[f"bend_{letter}{end}"] = float(bends.loc[name, ["alpha", "beta", "gamma"]].max())
            values[f"time_{letter}{end}"] = f"{rows.loc[name, 'settling_time_s']:.3f}"
            values[f"path_{letter}{end}"] = f"{rows.loc[name, 'path_ratio']:.2f}"
        values |= {f"{angle}_{end}": float(rows[f"{angle}0"].iloc[0]) for angle in ("alpha", "beta", "gamma")}
        values[f"peak_{end}"] = f"{responses.highest_deg(traces, start, FEEDBACK):.0f}"
        values[f"first_{end}"] = f"{responses.first_deg(traces, start):.0f}"
    return values


def failing(episodes: pd.DataFrame, boundaries: pd.DataFrame) -> dict:
    """Of the failure map; episodes of one engine."""
    linearized = of(episodes, LINEARIZED)
    failed = lost(linearized)
    outside = linearized[linearized["alpha0"].abs() > np.pi / 2.0]
    along = {key: boundaries.loc[boundaries["contender"] == name, "fails_from_rad"] for key, name in SHORT.items()}
    values = {
        "n": len(linearized),
        "percent": f"{100 * len(failed) / len(linearized):.1f}",
        "least": f"{np.degrees(failed['alpha0'].abs().min()):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
        "inside": int((failed["alpha0"].abs() < np.pi / 2.0).sum()),
        "outside": f"{100 * (1 - len(lost(outside)) / len(outside)):.0f}",
        "reach": f"{np.degrees(boundaries['settled_to_rad'].max()):.0f}",
        "axes": len(along["l"]),
        "axes_first": f"{np.degrees(along['l'].min()):.0f}",
        "axes_median": f"{np.degrees(along['l'].median()):.0f}",
    }
    for letter, name in SHORT.items():
        values |= {
            f"failed_{letter}": len(lost(of(episodes, name))),
            f"axes_{letter}": int(along[letter].notna().sum()),
        }
    return values

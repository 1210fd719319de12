"""What each inverse of a Jacobian costs, and what it buys on turns through the arm's own singularities."""

from __future__ import annotations

import pandas as pd

from report.figures.arms import arm_rows
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture

JOINTS = {6: style.Look("#0072b2", "o", style.SOLID), 7: style.Look("#d55e00", "s", style.DASHED)}
CONTROLLER = arm_rows.ON_MATRIX


def invert(rows: pd.DataFrame) -> pd.DataFrame:
    """A row an inverse, the cheapest first: flops of the stage `invert` by the number of joints."""
    own = rows[(rows["controller"] == CONTROLLER) & (rows["stage"] == "invert")]
    table = own.pivot_table(index="inverse", columns="joints", values="flops", sort=False)
    return table.loc[table.min(axis=1).sort_values(kind="stable").index]


@responsive_picture
def inverses(rows: pd.DataFrame, *, narrow=False):
    """Flops of each inverse, logarithmic; and the line of all the rest of the tick."""
    table = invert(rows)
    figure, axes = style.panels(height=1.1 + (0.42 if narrow else 0.34) * len(table), narrow=narrow)
    rest = rows[(rows["controller"] == CONTROLLER) & ~rows["stage"].isin(["total", "invert"])]
    said = []
    for joints, look in JOINTS.items():
        if joints not in table:
            continue
        marks = {"color": look.colour, "marker": look.marker, "linestyle": "none", "markersize": 7}
        axes.plot(table[joints], range(len(table)), label=f"{joints} joints", **marks)
        own = rest[rest["joints"] == joints]
        others = own.groupby("contender")["flops"].sum().max()
        axes.axvline(others, color=look.colour, linewidth=1.0, linestyle=look.line, label=f"all else, {joints} joints")
        said.append(
            f"{joints} joints: " + ", ".join(f"{name} {flops:.0f}" for name, flops in table[joints].dropna().items())
        )
    axes.set_yticks(
        range(len(table)),
        [
            arm_rows.title_of_inverse(name).replace(" least ", "\nleast ")
            if narrow
            else arm_rows.title_of_inverse(name)
            for name in table.index
        ],
    )
    axes.set(xscale="log", xlabel="Flops of one inversion a tick")
    axes.set_ylim(len(table) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    figure.legend(loc="outside upper left", ncols=2 if narrow else 4, columnspacing=1.2)
    return figure, f"Flops of one inversion a tick, logarithmic, by inverse. {'; '.join(said)}."


def bought(rows: pd.DataFrame, episodes: pd.DataFrame) -> html.Markdown:
    """A row an inverse: its price on six joints as part of the tick, and what became of the `wrist` starts with it.

    Args:
        rows: of `controller_costs.counted`; episodes: of `arm_rows.episodes`.
    """
    table = invert(rows)
    six = rows[(rows["controller"] == CONTROLLER) & (rows["joints"] == 6) & (rows["stage"] == "total")]
    totals = six.set_index("inverse")["flops"]
    wrist = episodes[(episodes["controller"] == CONTROLLER) & (episodes["start_set"] == "wrist")]
    square = wrist[wrist["arm"].isin([arm for arm in set(wrist["arm"]) if arm_rows.standard(arm, *split()) == "solve"])]
    cheapest = totals.min() if len(totals) else 0
    lines = []
    for name in table.index:
        own = square[square["inverse"] == name]
        if name not in totals:
            continue
        lines.append(
            {
                "Inverse": arm_rows.title_of_inverse(name),
                "Flops": int(table.at[name, 6]),
                "Tick": int(totals[name]),
                "Times the cheapest": totals[name] / cheapest,
                "Settle": f"{int((own['outcome'] == 'settled').sum())} of {len(own)}" if len(own) else html.MISSING,
                "Strays [mm]": 1e3 * own["position_error_m"].quantile(0.95) if len(own) else None,
                "Torque": own["peak_torque_ratio"].quantile(0.95) if len(own) else None,
            }
        )
    if not lines:
        return html.Markdown("| Inverses |\n| :-- |\n| Not in this run. |")
    frame = pd.DataFrame(lines)
    return html.table(frame, {"Times the cheapest": ".1f"})


def split() -> tuple[str, str]:
    """Law and Jacobian of CONTROLLER."""
    law, _, jacobian = CONTROLLER.partition("@")
    return law, jacobian


SAID = {
    "damped-least-squares": "Damping costs {times} times as much",
    "damped-least-squares-variable": "damping only where it is needed, to be exact elsewhere, {times} times",
    "truncated-svd": "leaving out small singular values, which takes their decomposition, {times} times",
}


def said(rows: pd.DataFrame, episodes: pd.DataFrame) -> str:
    """What each kind of damping costs over the plain inverse on six joints, and how many `wrist` starts each loses."""
    table = invert(rows)
    flops = table[6].dropna() if 6 in table else pd.Series(dtype=float)
    if not {"solve", *SAID} <= set(flops.index):
        return "Not in this run: it has one inverse for a number of joints, and no damped one."
    wrist = episodes[(episodes["controller"] == CONTROLLER) & (episodes["start_set"] == "wrist")]
    wrist = wrist[[arm_rows.standard(arm, *split()) == "solve" for arm in wrist["arm"]]]
    parts = []
    for name in ("solve", *SAID):
        own = wrist[wrist["inverse"] == name]
        lost = f"loses {int((own['outcome'] != 'settled').sum())} of {len(own)} starts" if len(own) else "was not run"
        price = SAID[name].format(times=f"{flops[name] / flops['solve']:.1f}") if name in SAID else ""
        parts.append(f"{price} and {lost}" if price else f"The plain inverse {lost}.")
    return f"{parts[0]} {'; '.join(parts[1:])}."

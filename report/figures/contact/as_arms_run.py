"""The page on impedance without inertia shaping: damping felt by mode, free motion, energy; limits of admittance."""

from __future__ import annotations

import functools
from collections.abc import Iterator

import pandas as pd

from bench.experiments.impedance import ZETA, Stiffness
from bench.findings.theory.impedance_modes import longest_tick, with_theory
from bench.law.control.unshaped import DAMPINGS
from bench.studies.contact.admittance import DECADES, FORCE_N, HALVINGS, SHIPPED
from report.figures.arms import arm_looks
from report.figures.contact.in_contact import study
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, in_run
from report.figures.kit.tables import Table

LOOKS = {
    "diagonal": style.Look("#d55e00", "s", style.DASH_DOT),
    "per-axis": style.Look("#0072b2", "o", style.SOLID),
    "double-diagonalization": style.Look("#009e73", "^", style.DASHED),
}
WITHIN = 10.0 ** ((DECADES[1] - DECADES[0]) / 2**HALVINGS) - 1.0
"""What bisection leaves of a limit on the arm."""
LAG_COLOURS = (style.INK, "#0072b2", "#009e73", "#d55e00")

SHORT = {"diagonal": "2√K", "per-axis": "per axis", "double-diagonalization": "double"}
FELT = Table(" | ".join(("Arm", "K [N/m, N m/rad]", *SHORT.values())), words=SHORT.values())
BARE = "panda"
"""The arm whose model has neither hand nor rotors."""
EXAMPLES = {
    "libfranka": Stiffness(150.0, 10.0),
    "franka_ros": Stiffness(200.0, 10.0),
    "end of its ranges": Stiffness(400.0, 30.0),
    "frankapy": Stiffness(600.0, 50.0),
    "here": Stiffness(2000.0, 50.0),
}
"""Stiffnesses with D = 2 sqrt(K): Franka's examples, frankapy's default on real Pandas, this benchmark's own choice."""
ROTORS = (0.0, 0.005, 0.01, 0.1)
"""Effective inertia [kg m^2] that each joint's rotor, or what else the loop feels, adds to the model."""
SENSITIVITY = Table(
    " | ".join(("Rotor [kg m² a joint]", *(f"{name}, {k:g}, {r:g}" for name, (k, r) in EXAMPLES.items()))),
    words=tuple(f"{name}, {k:g}, {r:g}" for name, (k, r) in EXAMPLES.items()),
)


@functools.cache
def modes(run: Run) -> pd.DataFrame:
    """Return the modes measured, beside theory's."""
    return with_theory(run.rows("impedance-modes").astype({"arm": str, "damping": str}))


@functools.cache
def episodes(run: Run) -> pd.DataFrame:
    """Episodes in free motion, with `settled` and `gap`, the share of its energy that is unaccounted for."""
    rows = run.rows("impedance")
    gone = rows["left_j"] + rows["damped_j"] + rows["elbow_j"] - rows["added_j"]
    return rows.astype({"arm": str, "damping": str, "compensated": str}).assign(
        settled=rows["outcome"].astype(str) == "settled", gap=(gone / rows["stored_j"] - 1.0).abs()
    )


def facts(run: Run) -> dict:
    """Return the numbers of the text."""
    return (in_run(lambda: in_free_motion(run)) or {}) | in_contact()


def in_free_motion(run: Run) -> dict:
    """Return the facts of modes and episodes."""
    found, rows = modes(run), episodes(run)
    felt = {name: found.loc[found["damping"] == name, "ratio"] for name in LOOKS}
    lost = found[found["radius"] >= 1.0].groupby(["arm", "stiffness_n_m", "stiffness_nm_rad"]).size().index
    whole = rows[rows["compensated"] == "bias"]
    moved = whole["added_j"] / whole["stored_j"]
    return {
        "felt_least": f"{felt['diagonal'].min():.2g}",
        "felt_most": f"{felt['diagonal'].max():.2g}",
        "asked": f"{found['zeta'].iloc[0]:g}",
        "double": f"{felt['double-diagonalization'].min():.3f} to {felt['double-diagonalization'].max():.3f}",
        "axis_least": f"{felt['per-axis'].min():.2g}",
        "axis_most": f"{felt['per-axis'].max():.2g}",
        "unstable": ", ".join(f"{arm_looks.title(arm)} at {k:g} N/m, {r:g} N m/rad" for arm, k, r in lost) or "none",
        "worst_gap": f"{100 * float((found['ratio'] / found['ratio_theory'] - 1.0).abs().max()):.1g}",
        "modes": len(found),
        "episodes": len(rows),
        "account": f"{100 * float(rows['gap'].max()):.1g}",
        "coriolis_least": f"{100 * float(moved.min()):.1f}",
        "coriolis_most": f"{100 * float(moved.max()):.1f}",
        "overshoots": ", ".join(
            f"{100 * float(rows.loc[rows['damping'] == name, 'overshoot'].max()):.2g}" for name in LOOKS
        ),
        "slower": f"{slower(rows, 'diagonal', 'double-diagonalization'):.2g}",
        "needs": needed_ticks(found),
        "tick": f"{1000 * dt_of(run):g}",
        **practice(dt_of(run)),
    }


def needed_ticks(found: pd.DataFrame) -> str:
    """Return the longest stable control period [ms] of the shipped rule on each arm, the least over its stiffnesses."""
    own = found[found["damping"] == "diagonal"].drop_duplicates(["arm", "stiffness_n_m"])
    ticks = {
        (one.arm, one.stiffness_n_m): longest_tick(
            one.arm, one.damping, Stiffness(one.stiffness_n_m, one.stiffness_nm_rad), one.zeta
        )
        for one in own.itertuples()
    }
    least = {arm: min(tick for (which, _), tick in ticks.items() if which == arm) for arm in own["arm"].unique()}
    return ", ".join(f"{1000 * tick:.2g} on the {arm_looks.title(arm)}" for arm, tick in least.items())


def tick_of(name: str, rotor: float) -> float:
    """Return the longest stable control period [s] of an example's stiffness on the bare arm with such rotors."""
    return longest_tick(BARE, "diagonal", EXAMPLES[name], ZETA, rotor)


def practice(dt: float) -> dict:
    """Return the default that runs on real arms, and the least of ROTORS with which all examples are stable at dt."""
    k, r = EXAMPLES["frankapy"]
    calm = [one for one in ROTORS if min(tick_of(name, one) for name in EXAMPLES) > dt]
    default = f"{k:g} N/m, {r:g} N m/rad (public since 2020)"
    return {"practice": default, "rotor_stable": f"{min(calm):g}" if calm else "none"}


def sensitivity(dt: float) -> list[tuple]:
    """Return a row for each rotor: the longest stable tick [ms] of each example, and whether dt is beyond it."""
    return [(f"{rotor:g}", *(word(tick_of(name, rotor), dt) for name in EXAMPLES)) for rotor in ROTORS]


def word(longest: float, dt: float) -> str:
    """Return a period in ms, with the word unstable where dt is longer."""
    return html.together(f"{1000 * longest:.2g}{', unstable' if longest < dt else ''}")


def slower(rows: pd.DataFrame, one: str, other: str) -> float:
    """How many times as long one design takes as another: the median over episodes that settle by both."""
    key = ["arm", "stiffness_n_m", "compensated", "start_id"]
    wide = rows[rows["settled"]].pivot_table(index=key, columns="damping", values="settling_time_s", observed=True)
    return float((wide[one] / wide[other]).median())


def in_contact() -> dict:
    """Return the study's numbers: planes that the impedance was pressed on, and limits of the admittance."""
    pressed, limits = study("unshaped"), study("admittance")
    calm, servos, arms = pressed[pressed["settles"]], *(limits[limits["plant"] == name] for name in ("servo", "arm"))
    slow = servos[servos["lag_ms"] == servos["lag_ms"].max()]
    off = {name: (own["measured"] / own["theory"] - 1.0).abs().max() for name, own in limits.groupby("plant")}
    lost = arms[arms["measured"].isna()]
    done = study("unshaped-tasks").pivot_table(index=["task", "arm"], columns="damping", values="done")
    apart = done.div(done["shaped"], axis=0) - 1.0
    return {
        "planes": f"{len(calm)} of {len(pressed)}",
        "plane_arms": pressed["arm"].nunique(),
        "given_share": f"{100 * float((calm['given'] / calm['stored']).max()):.0f}",
        "unaccounted": f"{100 * float(calm['unaccounted'].max()):.1f}",
        "servos": len(servos),
        "servo_gap": f"{100 * float(off['servo']):.1g}",
        "arm_gap": f"{100 * max(float(off['arm']), WITHIN):.1g}",
        "tasks": len(study("unshaped-tasks")["task"].unique()),
        "same": f"{100 * float(apart.abs().max().max()):.1g}",
        "shipped_m": f"{SHIPPED.m:g}",
        "shipped_d": f"{SHIPPED.d:.0f}",
        "shipped_k": f"{SHIPPED.k:g}",
        "force": f"{FORCE_N:g}",
        "lag": f"{slow['lag_ms'].iloc[0]:g}",
        "lag_k": f"{slow.loc[slow['delay_ms'] == 20, 'measured'].iloc[0] / 1000:.1f}",
        "never": f"{len(lost)} of {len(arms)}",
    }


def tables(run: Run) -> dict:
    """Return damping felt, and the bare arm with rotors."""
    return {"tab_felt": FELT(felt(modes(run))), "tab_rotors": SENSITIVITY(sensitivity(dt_of(run)))}


def felt(found: pd.DataFrame) -> Iterator[tuple]:
    """Return a row an arm and stiffness."""
    for (arm, k, r), own in found.groupby(["arm", "stiffness_n_m", "stiffness_nm_rad"]):
        ratios = (ratio(own[own["damping"] == name]) for name in LOOKS)
        yield arm_looks.title(arm), html.together(f"{k:g}, {r:g}"), *ratios


def dt_of(run: Run) -> float:
    """Return the control period [s]."""
    return float(episodes(run)["dt_s"].iloc[0])


def ratio(own: pd.DataFrame) -> str:
    """Return the least and the greatest of six modes."""
    low, high = f"{own['ratio'].min():.2g}", f"{own['ratio'].max():.2g}"
    said = low if low == high else f"{low} to {high}"
    return html.together(f"{said}, unstable" if own["radius"].iloc[0] >= 1.0 else said)


def figures(run: Run) -> dict:
    """Return ratios felt, and limits."""
    return {
        "ratios-felt": in_run(lambda: ratios_felt(modes(run))),
        "admittance-limits": stiffest(study("admittance")),
    }


@responsive_picture
def ratios_felt(rows: pd.DataFrame, narrow: bool):
    """Return the damping ratio of every mode over its frequency: marks measured, points theory."""
    figure, axes = style.panels(height=3.6 if narrow else 3.2, narrow=narrow)
    for name, look in LOOKS.items():
        own = rows[rows["damping"] == name]
        marks = {"linestyle": "none", "marker": look.marker, "markersize": 5, "color": look.colour, "alpha": 0.7}
        axes.plot(own["omega"], own["ratio"], label=DAMPINGS[name].title, **marks)
        axes.plot(own["omega_theory"], own["ratio_theory"], ".", color=style.INK, markersize=2)
    axes.axhline(float(rows["zeta"].iloc[0]), color=style.MUTED, linewidth=0.7, linestyle=style.DASHED)
    axes.set(xscale="log", yscale="log", xlabel="natural frequency of the mode [1/s]", ylabel="damping ratio felt")
    axes.set_yticks([0.2, 0.5, 1, 2, 5, 10], ["0.2", "0.5", "1", "2", "5", "10"])
    axes.set_xticks([1, 3, 10, 30, 100], ["1", "3", "10", "30", "100"])
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=1 if narrow else 3)
    spread = ", ".join(
        f"{DAMPINGS[name].title.lower()} {own.min():.2g} to {own.max():.2g}"
        for name, own in ((name, rows.loc[rows["damping"] == name, "ratio"]) for name in LOOKS)
    )
    return figure, f"Damping ratio of the modes of {rows['arm'].nunique()} arms where 1 is asked for: {spread}."


@responsive_picture
def stiffest(rows: pd.DataFrame, narrow: bool):
    """Return the stiffness up to which a press settles over the delay: marks measured, lines theory."""
    figure, axes = style.panels(height=3.6 if narrow else 3.2, narrow=narrow)
    words = []
    servos = rows[rows["plant"] == "servo"]
    for colour, (lag, own) in zip(LAG_COLOURS, servos.groupby("lag_ms"), strict=True):
        axes.plot(own["delay_ms"], own["theory"], color=colour)
        axes.plot(own["delay_ms"], own["measured"], "o", color=colour, markersize=5, label=f"servo, {lag:g} ms")
        words.append(
            f"{own['measured'].iloc[-1] / 1000:.1f} N/mm at {lag:g} ms of lag and {own['delay_ms'].max()} of delay"
        )
    arms = rows[(rows["plant"] == "arm") & rows["measured"].notna()]
    for marker, (lag, own) in zip("v^", arms.groupby("lag_ms"), strict=True):
        marks = {"color": style.MUTED, "markersize": 5, "label": f"UR5e, {lag:.0f} ms"}
        axes.plot(own["delay_ms"], own["theory"], color=style.MUTED, linestyle=style.DASHED)
        axes.plot(own["delay_ms"], own["measured"], marker, **marks)
    axes.set(yscale="log", ylim=(4e3, 2e5), xlabel="delay of the command [ms]", ylabel="stiffness [N/m]")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2 if narrow else 3)
    return figure, f"Stiffness up to which a press by admittance settles. {'; '.join(words)}."

"""What tasks in contact depend on, by `bench.studies.contact`: stiffness and delay, the fit of a peg, springs."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

from bench.base.files import read_json
from bench.engines.metrics.contact.scene import IN
from bench.findings.theory.jamming import margin
from bench.studies.contact.__main__ import STORED
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.tables import Table
from tasks.contact_model import STANDARD
from tasks.domains.peg_in_hole import OFFSET

LOOKS = {
    ("hybrid-base+transpose", 0.5): ("Jᵀ, kf 0.5", style.Look("#0072b2", "o", style.SOLID)),
    ("hybrid-base+transpose", 2.0): ("Jᵀ, kf 2", style.Look("#56b4e9", "v", style.DASHED)),
    ("hybrid-base+inverse", 0.5): ("accelerations", style.Look("#d55e00", "s", style.DASH_DOT)),
    ("impedance-geometric", 0.5): ("springs", style.Look("#009e73", "^", style.DOTTED)),
}
"""A controller and its gain on the error of force, as it is drawn."""

FITS = Table("Clearance [%] | Controller | Depth [mm] | At rest | Fastest of the others [mm/s]:.2g")
VARIANTS = Table("Contact | Cartesian, depth [mm] | Euler 45° [mm] | Euler 75° [mm] | At rest")
NOISE = Table("Controller | Sensor's delay [ms] | 10³ N/m:.2f | 10⁴:.2f | 10⁵:.2f | 10⁶ N/m:.2f")


@functools.cache
def part(name: str) -> pd.DataFrame:
    """A part of the study."""
    return pd.DataFrame(read_json(STORED)[name])


def facts() -> dict[str, str]:
    """Sentences: what springs leave, where a press becomes unstable, which pegs are jammed."""
    springs, boundary = part("springs"), part("boundary")
    steep = springs[springs["tilt_deg"] > 15.0].groupby("stiffness")["left_deg"].max().sort_index(ascending=False)
    ours = boundary[(boundary["controller"] == "hybrid-base+transpose") & (boundary["kf"] == 0.5)]
    late = boundary[boundary["measured"].notna() & boundary["theory"].notna()]
    exact = late[late["controller"] != "hybrid-base+transpose"]
    off = (exact["measured"] / exact["theory"]).to_numpy()
    return {
        "springs_left": ", ".join(f"{left:.2g}° by {k:g} N m/rad" for k, left in steep.items()),
        "springs_soft": f"{steep.index[-1]:g}",
        "boundary_papers": f"{len(ours) - int(ours['measured'].notna().sum())} of {len(ours)}",
        "boundary_off": f"{100.0 * np.abs(off - 1.0).max():.0f}",
        "boundary_longest": f"{ours['delay_ms'].max():g}",
        **_jammed(),
    }


def _jammed() -> dict[str, str]:
    own = loads()
    still, moving = own[own["rested"]], own[~own["rested"]]
    return {
        "jam_n": str(len(own)),
        "jam_still": f"{int((still['margin'] > 1.0).sum())} of {len(still)}",
        "jam_moving": f"{int((moving['margin'] <= 1.0).sum())} of {len(moving)}",
        "jam_slow": f"{1e3 * moving.loc[moving['margin'] > 1.0, 'speed_m_per_s'].max():.2g}",
        "peg_offset": f"{1e3 * np.hypot(*OFFSET):.1f}",
    }


def loads() -> pd.DataFrame:
    """Pegs of every fit that are held between the walls, with the load on them."""
    own = part("fits")
    own = own[own["margin"].notna()]
    mu = STANDARD.friction
    sheared = (own["turning"] - mu * (1.0 + own["lambda"]) * own["across"]) / own["lambda"]
    return own.assign(u=mu * own["across"], v=sheared, rested=own["rested"].astype(bool))


def said_of_fits(fits: pd.DataFrame) -> str:
    """How many pegs go in at each clearance, the widest first, and whether closer fits take fewer."""
    counts = (fits["depth_m"] >= IN).groupby(fits["clearance"]).agg(["sum", "size"]).sort_index(ascending=False)
    told = ", ".join(f"{one['sum']} of {one['size']} at {100 * share:g} %" for share, one in counts.iterrows())
    falls = counts["sum"].is_monotonic_decreasing and counts["sum"].nunique() > 1
    return f"{'fewer' if falls else 'not fewer'} pegs go in the closer they fit: {told} of play"


def tables() -> dict:
    """Fits, variants of the contact model, noise."""
    return {"tab_fits": FITS(_fits()), "tab_sensitivity": VARIANTS(_variants()), "tab_noise": NOISE(_noise())}


def _fits():
    for share, own in part("fits").groupby("clearance", sort=False):
        for name, mine in _by_frame(own):
            late = mine.loc[~mine["rested"].astype(bool), "speed_m_per_s"]
            fastest = 1e3 * late.max() if len(late) else np.nan
            yield f"{100 * share:g}", name, _depths(mine), _rested(mine), fastest


def _variants():
    for words, own in part("sensitivity").groupby("variant", sort=False):
        yield words, *(_depths(mine) for _, mine in _by_frame(own)), _rested(own)


def _by_frame(own: pd.DataFrame):
    beta = own["trial"].str.extract(r"beta\+(\d+)")[0].astype(int)
    for value, mine in own.groupby(beta):
        yield "Cartesian" if value == 0 else f"Euler Jacobian, β = {value}°", mine


def _depths(mine: pd.DataFrame) -> str:
    return html.together(", ".join(f"{1e3 * depth:.1f}" for depth in mine["depth_m"]))


def _rested(mine: pd.DataFrame) -> str:
    return html.together(f"{int(mine['rested'].sum())} of {len(mine)}")


def _noise():
    wide = part("noise").pivot_table(index=["controller", "kf", "delay_ms"], columns="stiffness", values="shake_n")
    for (controller, kf, delay), row in wide.iterrows():
        yield LOOKS[(controller, kf)][0], f"{delay:g}", *(row.get(k, np.nan) for k in (1e3, 1e4, 1e5, 1e6))


@responsive_picture
def stability(rows: pd.DataFrame, narrow: bool):
    """The stiffness up to which a press settles, over the sensor's delay: marks measured, lines theory.

    Args:
        rows: of the part `boundary`.
    """
    figure, axes = style.panels(height=3.4, narrow=narrow)
    words = []
    for (controller, kf), own in rows.groupby(["controller", "kf"], sort=False):
        name, look = LOOKS[(controller, kf)]
        axes.plot(own["delay_ms"], own["theory"], color=look.colour, linestyle=look.line)
        ends = own[own["measured"].notna()]
        shown = name if len(ends) else f"{name}: no boundary up to 10⁶ N/m"
        look_of_it = {"marker": look.marker if len(ends) else "", "color": look.colour, "linestyle": "none"}
        axes.plot(own["delay_ms"], own["measured"], markersize=5, label=shown, **look_of_it)
        least = f"{ends['measured'].min():.1e} N/m at {ends['delay_ms'].max():g} ms" if len(ends) else "no boundary"
        words.append(f"{name}: {least}")
    axes.set(yscale="log", ylim=(8e2, 1.3e6), xlabel="delay of the force sensor [ms]", ylabel="stiffness [N/m]")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2 if narrow else 4)
    return figure, f"Stiffness up to which a press on a plane settles, over the sensor's delay. {'; '.join(words)}."


@responsive_picture
def jamming(rows: pd.DataFrame, narrow: bool):
    """Loads of pegs that are not in, in the jamming diagram, sheared so that all depths share its square.

    Args:
        rows: as `loads` has them.
    """
    figure, axes = style.panels(height=3.6, narrow=narrow)
    axes.fill([-1, 1, 1, -1], [-1, -1, 1, 1], color=style.GRID, zorder=0)
    axes.text(0.0, -0.5, "slides", ha="center", color=style.MUTED)
    for rested, colour, name in ((True, "#0072b2", "at rest"), (False, "#d55e00", "still moves")):
        own = rows[rows["rested"] == rested]
        axes.plot(own["u"], own["v"], "o", color=colour, markersize=6, label=name)
    widest = 1.5 * float(rows["u"].abs().max())
    axes.set(xlabel="μ Fx/Fz (slides up to 1)", ylabel="(M/(r Fz) − μ (1 + λ) Fx/Fz)/λ", xlim=(-widest, widest))
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    inside = sum(margin(one.across, one.turning, one["lambda"], STANDARD.friction) <= 1.0 for _, one in rows.iterrows())
    return figure, f"Jamming diagram: of {len(rows)} pegs that are held between the walls {inside} lie in its square."


def figures() -> dict:
    """Both."""
    return {"stability-map": stability(part("boundary")), "jamming": jamming(loads())}

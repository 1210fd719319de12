"""The page on robots commanded in velocity: what is advised, the limits of K dt, and which laws stick or unwind."""

from collections.abc import Iterable

import pandas as pd

from bench.experiments.tables.run import Run
from bench.findings.amounts import capitalize, join_words
from bench.findings.claims.adequacy import DETOUR
from bench.findings.selection.regions import RuleVerdict
from bench.findings.selection.robots import VELOCITY, decide_for
from bench.findings.selection.words import standing, together
from bench.findings.theory.velocity_limits import with_theory
from report.figures.kit import families


def with_law(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows with `law`."""
    return rows.assign(law=rows["contender"].astype(str).str.partition("@")[0])


def facts(run: Run) -> dict:
    """Return the numbers of the text; none where no law of the run commands velocities."""
    rows = with_law(run.rows("velocity", arm="", limiter="none"))
    rows = rows[rows["share"] == 1.0].assign(settled=rows["outcome"].astype(str) == "settled")
    uniform, exact = (rows[rows["start_set"] == name] for name in ("uniform", "half-turn"))
    shares = exact.groupby("law")["settled"].mean()
    ways = uniform[uniform["settled"]].groupby("law")["path_ratio"].max()
    found = with_law(with_theory(run.rows("velocity-limits")))
    known = found[found["k_dt_theory"] > 0.0]
    logarithm = found.query("law == 'rotation-vector' and arm == '' and share == 1.0 and reach == 'near'")
    return {
        "lead": lead(decide_for(VELOCITY, run.folder)),
        "gain": float(rows["gain"].iloc[0]),
        "log_limit": f"{float(logarithm['k_dt'].iloc[0]):.3g}" if len(logarithm) else None,
        "uniform": len(uniform) // uniform["law"].nunique(),
        "exact": len(exact) // exact["law"].nunique(),
        "detour": f"{DETOUR:g}",
        "dead": named(shares.index[shares == 0.0]),
        "unwinds": named(ways.index[ways >= DETOUR]),
        "others": len(known),
        "worst_gap": f"{100 * float((known['k_dt'] / known['k_dt_theory'] - 1.0).abs().max()):.1g}",
    }


def named(laws: Iterable[str]) -> str:
    """Laws by their short words."""
    names = [families.word(name).replace(",", "") for name in families.in_order(laws)]
    return join_words(names) if names else "no law"


def lead(one: RuleVerdict | None) -> str:
    """Return what is advised, and with whom it ties."""
    if one is None or one.law is None:
        return "No law of this run settles from every start when it commands velocities."
    if not one.tied:
        return f"{families.word(one.law)}. {capitalize(standing(one, families.word))}"
    ties = together([families.word(law) for law in one.tied])
    laws = f"{ties} laws" if ties.endswith(" more") else ties
    tie = f"By our rule, this law ties with {laws}. It is the simplest of these laws."
    return f"{families.word(one.law)}. {tie}"

"""What leads of the book take from results, computed again from the tables by other code than the pages'.

A value is the text that a key shows, or a list: every number of that text, and words of it, in their order.
"""

import collections
import tomllib

import numpy as np
import pandas as pd
from scipy.stats import binomtest

import tasks
from bench.base.provenance import ROOT
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.law.attribution import IN_WORDS
from bench.law.contenders.registry import find_contender
from report.figures.kit.families import word
from support.advised import is_ours, velocities
from support.leads_of_arms import (
    CONTROLS,
    LINEARIZED,
    MATRIX,
    read_json,
    recompute_arms,
    recompute_compliance,
    recompute_impedance,
    recompute_libraries,
    recompute_new_law,
    recompute_times,
    recompute_torque_at_pole,
    torque_ratios_at_pole,
)
from support.map_rule import (
    NOTABLE,
    OVERSHOOT,
    SPOKEN,
    is_of_draw,
    map_rows,
    map_verdicts,
    shares_of,
    slower_pairs,
    widest,
)
from support.tables import table
from tasks.condition import condition_at
from tasks.situation import COORDINATES


def list_together(words):
    """Return the first three words and how many more, or four and fewer whole."""
    return words if len(words) <= 4 else [*words[:3], len(words) - 3]


def uniform():
    """Return the uniform starts of the free body on the continuous plant that converge."""
    asked = "engine == 'ideal-rk4' and task == 'free-body' and start_set == 'uniform' and converged != 'no'"
    return table("episodes").query(asked)


def recompute_failure_map():
    cells = table("map", "maps/kv-20").query(f"row == 'cell' and law == '{LINEARIZED}' and most_speed == 0")
    n, *fine = cells[["starts", "settled", "unconverged"]].sum().astype(int)
    bad = n - sum(fine)
    low, high = binomtest(bad, n).proportion_ci(0.95)
    return {
        "mapped_l": f"{100 * bad / n:.2f} % (95 % interval: {100 * low:.2f} to {100 * high:.2f} %)",
        "mapped": n,
    }


def recompute_comparison():
    rows = uniform().query(f"law not in {CONTROLS}")
    n = rows["law"].nunique()
    shared = rows.groupby("start_id")["law"].nunique().loc[lambda found: found == n].index
    rows = rows[rows["start_id"].isin(shared)]
    settled = rows["outcome"] == "settled"
    rows = rows.assign(time=rows["settling_time_s"].where(settled, np.inf), cost=rows["effort"].where(settled, np.inf))
    middle, cost = (rows.groupby("law")[name].quantile(0.5, interpolation="lower") for name in ("time", "cost"))
    said = {"laws": n, "starts": len(shared), "dearer": f"{cost.max() / cost.min():.0f}"}
    for angle in (30, 60):
        own = rows[(rows["angle0_rad"] < np.radians(angle)) & (rows["law"] != "weighted-columns")]
        medians = own.groupby("law")["settling_time_s"].median()
        said |= {f"within_{angle}": own["start_id"].nunique()}
        said |= {f"apart_{angle}": f"{np.ceil(100 * (medians.max() / medians.min() - 1) - 1e-9):.0f}"}
    return said | {"fastest_s": f"{middle.min():.2f}", "slowest_s": f"{middle.max():.2f}"}


def recompute_thresholds():
    """Return the perturbations along which the laws' thresholds in the study differ, and noise at 180° in the run."""
    lasts = [name for name in tasks.axis_names() if condition_at(tasks.axis(name), max(tasks.axis(name).levels)).lasts]
    run, study = table("robustness"), table("perturbed", "robustness")
    good = (run["tail_rms_rad"] <= np.radians(3)).where(run["axis"].isin(lasts), run["outcome"] == "settled")
    own = good.groupby([run["law"], run["axis"], run["level"]]).agg(good="sum", starts="size").reset_index()
    rows = pd.concat([study[study["law"].isin(run["law"])], own[~own["law"].isin(study["law"])]])
    rows = rows.query(f"law not in {CONTROLS}")
    each = collections.defaultdict(dict)
    for (law, axis), own in rows.groupby(["law", "axis"]):
        share, nominal = (own["good"] / own["starts"]).set_axis(own["level"]), tasks.axis(axis).nominal
        start = share.index.max() if nominal is None else nominal
        for grows in (True, False):
            outwards = share.sort_index(ascending=grows).loc[start:]
            if len(outwards) > 1:
                is_kept = (outwards >= max(0.5, outwards.iloc[0] - 0.05)).cummin()
                held = outwards.index[is_kept]
                each[axis, not grows][law] = (held[-1], is_kept.all()) if len(held) else None
    known = {law for own in each.values() for law, held in own.items() if held}
    apart = [way for way, own in sorted(each.items()) if len({own[law] for law in known}) > 1]
    titles = [f"{tasks.axis(axis).title.lower()}{' (decreasing)' * falls}" for axis, falls in apart]
    return {"apart": "; ".join(titles), "changed_situations.default": word(widest()[0][0])}


def recompute_noise():
    """Return the worst noise that no memory of a known width fails at, and who leaves 180° under it."""
    noise = table("robustness").query(f"axis == 'half-turn-noise' and law not in {CONTROLS} and level > 0")
    left = (noise["outcome"] == "settled").groupby([noise["law"], noise["level"]]).mean().unstack()
    remembers = np.array([find_contender(law).regulator.memory is not None for law in left.index])
    sided = remembers & (left.index != "synergistic")  # those whose width theory knows
    middle = max(level for level in left if (left.loc[sided, level] == 1.0).all())
    # at this level no start is lost, by its choice
    return {
        "half_turn_noise.middle": f"{middle:g}",
        "half_turn_noise.blind_middle": f"{100 * left.loc[~remembers, middle].max():.0f}",
        "half_turn_noise.memory_middle": "with all these laws, the body leaves 180° from every start",
    }


def recompute_velocities():
    rows = table("velocity-limits").query("law == 'rotation-vector' and arm == '' and share == 1 and reach == 'near'")
    law, tied, *_, asked = velocities().decide()
    said = [word(law), *list_together([*map(word, tied)])] if tied else [word(law), asked, 5]
    return {"log_limit": f"{rows['k_dt'].iloc[0]:.3g}", "lead": said}


def percent(counts, name):
    """Write a share of counted situations."""
    return f"{100 * counts[name] / counts['of']:.0f} %"


def recompute_shares(law):
    """Return what is said of a law's shares: both sets from 5 % on, then from 1 %, with how many laws are compared."""
    near, close = shares_of(law, SPOKEN), shares_of(law, NOTABLE)
    rows = map_rows()
    rows = rows[[is_of_draw(at) for at in rows[[*COORDINATES]].itertuples(index=False, name=None)]]
    anywhere = rows.groupby("law")["qualified"].any()
    others = anywhere[[not is_ours(name) for name in anywhere.index]]
    said = [percent(near, "qualified"), near["of"], "5 %", len(others), percent(near, "all"), (~others).sum()]
    said += [f"{100 * NOTABLE:g} %", percent(close, "qualified"), percent(close, "all"), percent(near, "losing")]
    return said


def recompute_price(law, other):
    """Return what is said of a law's price beside another's."""
    rows = map_rows()
    is_drawn = [is_of_draw(at) for at in rows[[*COORDINATES]].itertuples(index=False, name=None)]
    is_nominal = (rows[[*COORDINATES]] == [one.nominal for one in COORDINATES.values()]).all(axis=1)
    overshoots = rows[is_drawn].groupby("law")["overshoot"].median()
    nominal = rows[is_nominal].set_index("law")
    equal = nominal["time"] * np.sqrt(nominal["peak"])
    said = []
    for numbers, digits in ((nominal["peak"], 1), (equal, 1), (overshoots, 1)):
        said += [99] if numbers is equal else []
        said += [f"{numbers[law]:.{digits}f}", word(other), f"{numbers[other]:.{digits}f}"]
    return said


def recompute_reason(law):
    """Return the numbers of why a law is advised: where it meets all that is asked, and where no such law is faster."""
    near = shares_of(law, SPOKEN)
    low, high = binomtest(near["qualified"], near["of"]).proportion_ci(0.95)
    meets = round(100 * (1 - near["failing"] / near["of"]))
    shares = [round(100 * share) for share in (near["qualified"] / near["of"], low, high)]
    return [meets, 180, 0.1, OVERSHOOT, *shares, 100 * SPOKEN, *recompute_widest_share(law)]


def recompute_widest_share(law):
    """Return the share of the law that is unbeaten in most drawn situations, in per cent, where it is another law."""
    others = [name for name in map_rows()["law"].unique() if not is_ours(name)]
    counts = {name: shares_of(name, SPOKEN)["qualified"] for name in others}
    most = max(counts.values())
    return [] if counts[law] == most else [round(100 * most / shares_of(law, SPOKEN)["of"])]


def recompute_costs(law):
    """Return the numbers that a law keeps, and its price beside the law of the second widest region."""
    other = widest()[1][0]
    price = [float(number) for number in recompute_price(law, other) if number != word(other)]
    return [len(find_contender(law).regulator.memory), *price]


def recompute_resets(law):
    """Return what is said of a reset of the memory."""
    rows = table("perturbed", "robustness").query("law == @law and 0 < level <= 0.2")
    kept, reset = (rows[rows["axis"] == axis] for axis in ("goal-jump", "goal-jump-reset"))
    shares = [f"{100 * own['long'].sum() / own['far'].sum():.1f} %" for own in (kept, reset)]
    times = [f"{time:.3f}" for own in (reset, kept) for time in (own["median_s"].min(), own["median_s"].max())]
    return ["0.2", shares[1], "1.5", shares[0], kept["far"].sum(), "0.5", *times]


def recompute_default():
    """Return what is said of the law of the widest region, in chapter 7."""
    law = widest()[0][0]
    rows = table("situations", "situations")
    nominal = rows[(rows["zeta"] == 1.0) & (rows["law"] == law) & (rows["period"] == 0.01)]
    nominal = nominal[
        np.isinf(nominal["bound"]) & (nominal[["delay", "unevenness", "spin", "jump"]] == 0.0).all(axis=1)
    ]
    [time] = nominal.loc[nominal["inertia"] == 1.0, "time"]
    return [100, 99, f"{time / 10:.2f} s", 0.1, 180, *recompute_shares(law)]


def recompute_ours():
    """Return what is said of our own laws that are faster than the advised one in some drawn situation."""
    said = []
    for law in sorted({name for name in map_rows()["law"] if is_ours(name)}):
        beats = count_wins(law)
        if beats:
            free = shares_of(law, SPOKEN)
            said += [word(law), 2026, "5 %", f"{100 * beats / free['of']:.0f} %"]
            said += [percent(free, "qualified"), "5 %", percent(free, "all")]
    return said


def count_wins(law):
    """Return in how many drawn situations a law meets the requirements and is faster than the advised one."""
    rows = map_rows()
    qualified = set(rows[(rows["law"] == law) & rows["qualified"]]["word"])
    wins = 0
    for at, (advised_law, *_) in map_verdicts().items():
        name = "_".join(f"{value:g}" for value in at)
        is_tried = advised_law and is_of_draw(at) and name in qualified
        wins += bool(is_tried) and (name, advised_law, law) in slower_pairs(SPOKEN)
    return wins


def recompute_advice():
    """Return what chapter 7 says of the law of the widest region, and of ours."""
    law = widest()[0][0]
    lead = [word(law), IN_WORDS[find_contender(law).attribution], *recompute_costs(law)]
    said = {"does": recompute_default(), "ours": recompute_ours()}
    return {"lead": lead, "reason": recompute_reason(law), **said}


def recompute_use_today():
    """Return what the front page says of the law to use, and of its price."""
    law = widest()[0][0]
    attribution = IN_WORDS[find_contender(law).attribution]
    laws = sum(not is_ours(name) for name in map_rows()["law"].unique())
    answer = [word(law), attribution, *recompute_reason(law), shares_of(law, SPOKEN)["of"], laws]
    return {"answer": answer, "price": recompute_costs(law)}


def recompute_abstract():
    """Return the numbers of the abstract."""
    about, rows = read_json("reference/provenance.json"), table("episodes")
    at_rest = rows.query("engine == 'ideal-rk4' and task == 'free-body' and converged != 'no'")
    at_rest = at_rest[at_rest["start_set"].isin(("uniform", "half-turn", "poles", "wraps", "box"))]
    half_turns = at_rest[(at_rest["law"] == MATRIX) & (np.pi - at_rest["angle0_rad"] < 1e-13)]
    failed = (half_turns["outcome"] != "settled").sum()
    linearized = at_rest[(at_rest["law"] == LINEARIZED) & (at_rest["start_set"] == "uniform")]
    lost = (linearized["outcome"] != "settled").sum()
    low, high = binomtest(int(lost), len(linearized)).proportion_ci(0.95, method="wilson")
    verdicts = recompute_verdicts()
    arms = rows.loc[rows["arm"] != "", "arm"].nunique()
    said = [1988, about["episodes"] + about["trials"] + about["troubled"], f"{arms} arms"]
    said += [verdicts["decided"], *verdicts["words"], f"{len(read_history())} of these criteria"]
    said += [f"all {failed}" if failed == len(half_turns) else f"{failed} of {len(half_turns)}", 180]
    said += [f"{100 * lost / len(linearized):.1f} %", f"{100 * low:.1f} to {100 * high:.1f} %", len(linearized)]
    harder = torque_ratios_at_pole()
    said += [f"{float(format(np.median(harder), '.2g')):g} times", f"{len(harder)} moves", "answered"]
    return {"abstract": [*said, *list_answers()]}


def count_all_episodes():
    """Return the episodes of a run of all kinds."""
    about = read_json("reference/provenance.json")
    return {"episodes": [about["episodes"] + about["trials"] + about["troubled"]]}


def read_history():
    """Return the claims with an earlier criterion."""
    with (ROOT / "bench/findings/claims/history.toml").open("rb") as file:
        return tomllib.load(file)


def list_answers():
    """Return three later laws that pass all tests of C27 and how many more, as its evidence has them."""
    [verdict] = [one for one in claims.judge_all(RESULTS / "reference") if one.id == "C27"]
    passing = verdict.evidence.instead.partition(": ")[2].partition(". ")[0]
    names = [answer.partition(" (")[0] for answer in passing.split("; ")]
    law = widest()[0][0]
    first = sorted(names, key=lambda name: name != law)
    return [*(word(name) for name in first[:3]), f"{len(names) - 3} more"] if len(names) > 4 else map(word, first)


def recompute_verdicts():
    now = {id: str(one) for id, one in read_json("verdicts/verdicts.json")["reference"].items()}
    verdicts = claims.judge_all(RESULTS / "reference")
    for verdict in verdicts:
        # A claim that is newer than the study.
        now.setdefault(verdict.claim.id, str(verdict.word))
    first = dict(now)
    for verdict in verdicts:
        for word_of_first in (one.word for one in verdict.claim.earlier[:1]):
            first[verdict.claim.id] = str(word_of_first or verdict.evidence.earlier[0])
    order = {"holds": [], "holds with a correction": [], "does not hold": []}
    order |= {"open in 1988; answered since": [1988], "depends on the gains": [], "depends on how it is read": []}
    order |= {"not testable": [], "not tested": []}
    said = [
        [number for word, more in order.items() if (n := list(words.values()).count(word)) for number in (n, *more)]
        for words in (now, first)
    ]
    return {"decided": len(now), "words": said[0], "first_words": said[1]}


COMPUTED = {
    "index": lambda: recompute_abstract() | recompute_use_today(),
    "02-three-regulators": recompute_failure_map,
    "04-euler-jacobian": recompute_torque_at_pole,
    "appendix-data": count_all_episodes,
    "03-cost": recompute_times,
    "appendix-arms": recompute_arms,
    "05-compliance-and-contact": recompute_compliance,
    "06-what-an-error-must-do": recompute_noise,
    "appendix-side-by-side": recompute_comparison,
    "08-delay-noise-limits": lambda: recompute_thresholds() | {"goal_jumps.resets": recompute_resets(widest()[0][0])},
    "appendix-velocity": recompute_velocities,
    "appendix-impedance": recompute_impedance,
    "09-libraries": recompute_libraries,
    "07-which-error": recompute_advice,
    "appendix-late-braking": recompute_new_law,
    "01-murphy-1988": recompute_verdicts,
    "appendix-claims": lambda: {"claims.count": recompute_verdicts()["decided"]},
}
"""Page -> key -> its text, or numbers and words of it."""

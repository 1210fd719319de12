"""What leads of the book take from results, computed again from the tables by other code than the pages'."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.stats import binomtest, fisher_exact

from bench.tables.schema import RESULTS

CONTROLS = ("quaternion-unwinding", "linearized-euler-literal/zyx-euler")
CARTESIAN, EULER = "hybrid-base", "hybrid/zyx-euler"


def table(name, folder="reference"):
    """A table with plain words and `law`."""
    found = pd.read_parquet(RESULTS / folder / f"{name}.parquet")
    words = found.select_dtypes("category").columns
    found = found.astype(dict.fromkeys(words, str))
    if "regulator" in found:
        found["law"] = found["regulator"] + np.where(found["representation"] == "", "", "/") + found["representation"]
    return found


def uniform():
    """Uniform starts of the free body on the continuous plant, those that converge."""
    rows = table("episodes").query("engine == 'ideal-rk4' and task == 'free-body' and start_set == 'uniform'")
    return rows[rows["converged"] != "no"]


def lost(law):
    own = uniform().query("law == @law")
    return own[own["outcome"] != "settled"]


def failure_map():
    cells = table("map", "maps").query("row == 'cell' and law == 'linearized-euler/zyx-euler' and most_speed == 0")
    n = int(cells["starts"].sum())
    bad = n - int(cells[["settled", "unconverged"]].sum().sum())
    low, high = binomtest(bad, n).proportion_ci(0.95)
    others = [len(lost(law)) for law in ("rotation-matrix", "feedback-linearized/zyx-euler")]
    own = lost("linearized-euler/zyx-euler")
    return {
        "n": (uniform()["law"] == "linearized-euler/zyx-euler").sum(),
        "failed_others": " and ".join(map(str, others)) if any(others) else "none",
        "mapped_l": f"{100 * bad / n:.2f} % ({100 * low:.2f} to {100 * high:.2f})",
        "mapped": n,
        "failed_l": len(own),
        "least": f"{np.degrees(own['alpha0'].abs().min()):.0f}",
    }


def side_by_side():
    rows = uniform().query("law not in @CONTROLS")
    n = rows["law"].nunique()
    shared = rows.groupby("start_id")["law"].nunique().loc[lambda found: found == n].index
    rows = rows[rows["start_id"].isin(shared)]
    settled = rows["outcome"] == "settled"
    rows = rows.assign(time=rows["settling_time_s"].where(settled, np.inf), cost=rows["effort"].where(settled, np.inf))
    middle, cost = (rows.groupby("law")[name].quantile(0.5, interpolation="lower") for name in ("time", "cost"))
    near = {}
    for angle in (30, 60):
        own = rows[(rows["angle0_rad"] < np.radians(angle)) & (rows["law"] != "weighted-columns")]
        medians = own.groupby("law")["settling_time_s"].median()
        near |= {f"within_{angle}": own["start_id"].nunique()}
        near |= {f"apart_{angle}": f"{100 * (medians.max() / medians.min() - 1):.0f}"}
    ends = {"fastest_s": f"{middle.min():.2f}", "slowest_s": f"{middle.max():.2f}"}
    return {**near, **ends, "laws": n, "starts": len(shared), "dearer": f"{cost.max() / cost.min():.0f}"}


def contact(task):
    rows = table("compliance").query("task == @task")
    coordinates = np.where(rows["representation"] == "", "", "/") + rows["representation"]
    return rows.assign(who=rows["controller"] + coordinates, tilt_deg=np.degrees(rows["beta"]).round(6))


def compliance():
    rows = contact("wrench-probe").query("complies == 'about x and y' and alpha == 0 and gamma == 0")
    drawn = rows.query("form == 'transpose' and arm == 'ur5e'").set_index("tilt_deg")
    euler, plain = (drawn[drawn["who"] == who] for who in (EULER, CARTESIAN))
    full, betas = plain["c_xx"].median(), [30.0, 60.0, 85.0]
    C = {
        beta: euler.loc[beta, [f"c_{i}{j}" for i in "xyz" for j in "xyz"]].to_numpy(float).reshape(3, 3)
        for beta in betas
    }
    off = {beta: np.degrees(np.arctan2(np.hypot(*C[beta][1:, 0]), abs(C[beta][0, 0]))) for beta in betas}
    held = {beta: 100 * np.linalg.norm(C[beta][:, 2]) / full for beta in betas}
    plain_held = 100 * np.linalg.norm(plain.loc[60.0, ["c_xz", "c_yz", "c_zz"]].to_numpy(float)) / full
    by = rows[(rows["form"] == "inverse") & (rows["who"] == EULER) & (rows["outcome"] == "done")]
    worst = np.abs(np.degrees(by["misalignment_rad"]) - by["tilt_deg"].abs()).max()
    exponent = int(np.floor(np.log10(worst)))
    return {
        "off": ", ".join(f"{value:.0f}° at β = {beta:.0f}°" for beta, value in off.items()),
        "off_word": "less than β" if all(value < beta for beta, value in off.items()) else "not always less than β",
        "held": ", ".join(f"{value:.0f} % at β = {beta:.0f}°" for beta, value in held.items()),
        "held_cartesian": f"{plain_held:.0f} %",
        "off_by_accelerations": [round(worst / 10.0**exponent), -exponent],
    }


def pegs(form):
    rows = contact("peg-in-hole").query("form == @form")
    tallies = []
    for who in (CARTESIAN, EULER):
        own = rows[rows["who"] == who]
        leans = own["tilt_deg"] != 0
        out = ~(own["jam"] == 0.0)
        tallies.append((out.sum(), len(own), (out & leans).sum(), leans.sum()))
    p = fisher_exact([(bad, n - bad) for *_, bad, n in tallies]).pvalue
    return [*tallies[0], *tallies[1], float(f"{p:.2g}")]


def in_contact_numbers():
    rows, said = contact("surface-alignment").query("form == 'transpose'"), []
    for who in (CARTESIAN, EULER):
        own = rows[rows["who"] == who]
        flat, leans = own["time_to_align_s"].notna(), own["tilt_deg"] != 0
        turned = float(f"{np.degrees(own['held_turn_rad'].max()):.1f}")
        said += [flat.sum(), len(own), (flat & leans).sum(), leans.sum(), turned]
    fits = pd.DataFrame(json.loads((RESULTS / "contact/contact.json").read_text(encoding="utf-8"))["fits"])
    is_in = (fits["depth_m"] >= 0.027).groupby(fits["clearance"]).agg(["sum", "size"]).iloc[::-1]
    by_fit = [number for share, (good, n) in is_in.iterrows() for number in (good, n, 100 * share)]
    return {"flat": said, "stuck": pegs("transpose"), "other_stuck": pegs("inverse"), "fits": by_fit}


def share(passes):
    """Percent with Wilson's interval, rounded, and n."""
    low, high = binomtest(int(passes.sum()), len(passes)).proportion_ci(0.95, method="wilson")
    return [*(round(100 * value) for value in (passes.mean(), low, high)), len(passes)]


def as_arms_run():
    rows = table("impedance-modes")
    felt = rows.query("damping == 'diagonal'")["ratio"]
    lost = rows[rows["radius"] >= 1.0].groupby(["arm", "stiffness_n_m", "stiffness_nm_rad"]).size().index
    return {
        "felt_least": f"{felt.min():.2g}",
        "felt_most": f"{felt.max():.2g}",
        "tick": f"{1000 * table('impedance')['dt_s'].iloc[0]:g}",
        "unstable": [value for _, *pair in lost for value in pair],
    }


def regressions():
    planted = [one for one in json.loads((RESULTS / "regress/faults.json").read_text())["rows"] if one["law"]]
    builds = [json.loads(path.read_text()) for path in (RESULTS / "history").glob("*/*.json")]
    return {
        "planted": len(planted),
        "caught": sum(one["caught"] and one["named"] for one in planted),
        "builds": len({one["commit_info"]["id"] for one in builds}),
        "benchmarks": len({one["param"] for build in builds for one in build["benchmarks"]}),
    }


def limit_of_the_logarithm():
    rows = table("velocity-limits").query("law == 'rotation-vector' and arm == '' and share == 1 and reach == 'near'")
    return {"log_limit": f"{rows['k_dt'].iloc[0]:.3g}"}


def new_law():
    """sin(theta/2) springs stiffened by 1 + cos²(theta/2), damping eased: integrated from rest at many angles."""
    e, grid = (lambda theta: np.sin(theta / 2)), np.linspace(0, np.pi, 100_001)
    angles = np.linspace(1e-3, np.pi, 25)
    theta, rate, last, h = angles.copy(), np.zeros(25), np.zeros(25), 1e-4

    def push(theta, rate):
        s2 = 1 - e(theta) ** 2
        return -((1 + s2) * 100 + 16 * np.maximum(0, -e(theta) * rate)) * e(theta) - 20 * rate

    for tick in range(20_000):
        middle = theta + h / 2 * rate, rate + h / 2 * push(theta, rate)
        theta, rate = theta + h * middle[1], rate + h * push(*middle)
        last = np.where(np.abs(theta) > 0.02 * angles, (tick + 1) * h, last)
    return {"slowest": f"{last.max():.3f}", "pull": f"{((2 - e(grid) ** 2) * e(grid)).max():.2f}"}


def advice():
    """Of the law that is advised first: 99 % of starts settled, and the noise that traps no law of the answer."""
    times = uniform().query("law == 'late-braking'").sort_values("settling_time_s")["settling_time_s"]
    return {"lead": [float(f"{times.quantile(0.99):.3f}")]}


def arms():
    rows = table("episodes").query("task == 'arm-regulation' and start_set == 'uniform' and variation == 'nominal'")
    seven, tall = rows["arm"] == "panda", rows["law"] == "feedback-linearized/quaternion"  # J_E of four rows for three
    usual = np.select([seven & tall, seven | tall], ["truncated-svd", "pseudo-inverse"], "solve")
    rows = rows[(rows["inverse"] == usual) & rows["jacobian"].isin(("geometric", "analytic"))]
    rows = rows[~rows["regulator"].isin(("joint-pd", "resolved-rate"))]
    euler = rows.query("law == 'feedback-linearized/zyx-euler' and jacobian == 'analytic'")
    is_within = (euler["outcome"] == "settled") & (euler["peak_torque_ratio"] <= 1) & (euler["range_excess_rad"] <= 0)
    return {"lead": [len(rows), round(100 * (rows["peak_torque_ratio"] > 1).mean()), *share(is_within)]}


def libraries():
    loops = table("closed_loop", "libraries").query("library != 'orientation-bench' and kind == 'function'")
    at = loops[loops["angle_deg"] == 180].groupby(["library", "function"])[["dead", "starts"]].sum()
    below = loops[loops["angle_deg"] < 180].groupby(["library", "function"])["away"].sum()
    origins = json.loads((RESULTS / "libraries/provenance.json").read_text(encoding="utf-8"))["libraries"]
    counts = {"loops": len(at), "loops_dead": (at["dead"] == at["starts"]).sum(), "loops_away": (below > 0).sum()}
    asked = table("libraries", "libraries").query("library != 'orientation-bench' and form != 'z-y-x'")
    kinds = asked.drop_duplicates(["library", "function"])["kind"].value_counts()
    counts |= {"functions": kinds["function"], "idioms": kinds["idiom"]}
    return {**counts, "libraries": len(set(origins) - {"orientation-bench"})}


def shares_of_time():
    [path] = (RESULTS / "timings").glob("*.parquet")
    rows = table(path.stem, "timings").query("ticks > 0")
    is_whole = (rows["what"] == "controller") & (rows["law"] == "rotation-matrix") & (rows["jacobian"] == "geometric")
    alone = rows[(rows["what"] == "law") & ~rows["law"].str.contains("literal")].set_index("law")["ratio"]
    share = 100.0 * alone / rows.loc[is_whole, "ratio"].median()
    found = {"matrix": share["rotation-matrix"], "late": share["late-braking"], "most": share.max()}
    return {f"cost_on_arms.time_{name}": [float(f"{value:.2g}")] for name, value in found.items()}


def method():
    return {"engines": table("episodes").query("task == 'free-body'")["engine"].nunique()}


def verdicts():
    words = list(json.loads((RESULTS / "verdicts/verdicts.json").read_text(encoding="utf-8"))["reference"].values())
    order = ("holds", "holds with a correction", "does not hold", "open in 1988; answered since")
    order += ("depends on the gains", "not testable")
    return {"decided": len(words), "words": [words.count(word) for word in order if word in words]}


def faults():
    files = Path("bench/audit/faults").glob("[a-z]*.py")
    return {"check_your_error.faults": sum("FAULT" in file.read_text(encoding="utf-8") for file in files)}


COMPUTED = {
    "index": lambda: {
        "off": compliance()["off"],
        "pegs": pegs("transpose"),
        "pegs_by_accelerations": pegs("inverse"),
    },
    "06-failure-map": failure_map,
    "07-cost": shares_of_time,
    "08-arms": arms,
    "13-compliance": compliance,
    "14-in-contact": in_contact_numbers,
    "15-comparison": side_by_side,
    "17-velocity-commands": limit_of_the_logarithm,
    "23-as-arms-run": as_arms_run,
    "25-libraries": libraries,
    "27-which-law": advice,
    "28-a-new-law": new_law,
    "29-take-it-home": faults,
    "30-method": method,
    "31-regressions": regressions,
    "40-claims": verdicts,
}
"""Page -> key -> text, or the numbers that its text has, in their order, among others."""

"""Compute again what leads say of arms, contact, libraries, our law, the history and the code; see `support.leads`."""

import json

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.stats import binomtest

import tasks
from bench.audit.examined import COUNT_RAD
from bench.experiments.tables.schema import RESULTS
from bench.findings.theory.impedance_modes import hand_matrices, hand_of
from report.figures.kit.families import word
from support import advised
from support.advised import costs, is_ours, operations, shares_of_time
from support.tables import table

CARTESIAN, EULER = "hybrid-base", "hybrid/zyx-euler"
MATRIX, LINEARIZED, FEEDBACK = "rotation-matrix", "linearized-euler/zyx-euler", "feedback-linearized/zyx-euler"
LATE = "late-braking"
CONTROLS = ("quaternion-unwinding", "linearized-euler-literal/zyx-euler")


def read_json(name):
    """Return a JSON file of results."""
    return json.loads((RESULTS / name).read_text(encoding="utf-8"))


def contact(task):
    """Return the rows of a task in contact, with the controller and its coordinates and the tilt."""
    rows = table("compliance").query("task == @task")
    coordinates = np.where(rows["representation"] == "", "", "/") + rows["representation"]
    return rows.assign(who=rows["controller"] + coordinates, tilt_deg=np.degrees(rows["beta"]).round(6))


def recompute_compliance():
    rows = contact("wrench-probe").query("complies == 'about x and y' and alpha == 0 and gamma == 0")
    drawn = rows.query("form == 'transpose' and arm == 'ur5e'").set_index("tilt_deg")
    euler = drawn[drawn["who"] == EULER]
    betas = [30.0, 60.0, 85.0]
    entries = [f"c_{i}{j}" for i in "xyz" for j in "xyz"]
    C = {beta: euler.loc[beta, entries].to_numpy(float).reshape(3, 3) for beta in betas}
    off = {beta: np.degrees(np.arctan2(np.hypot(*C[beta][1:, 0]), abs(C[beta][0, 0]))) for beta in betas}
    *most, last = (f"{value:.0f}° at β\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}{beta:.0f}°" for beta, value in off.items())
    said = f"{', '.join(most)} and {last}"
    rows = contact("surface-alignment").query("form == 'transpose'")
    flat = [rows.loc[rows["who"] == who, "time_to_align_s"].notna() for who in (EULER, CARTESIAN)]
    return {"off": said, "in_contact.flat": [count for own in flat for count in count_flat(own)]}


def count_flat(is_flat):
    """Return the numbers of a sentence: all are one number."""
    return ["all", len(is_flat)] if is_flat.all() else [is_flat.sum(), len(is_flat)]


def recompute_impedance():
    rows = table("impedance-modes")
    rows = rows[rows["variation"] != "ideal-motors"]
    franka = rows.query("arm == 'panda' and damping == 'diagonal' and stiffness_n_m == 600")
    designs = franka.drop_duplicates(["variation", "stiffness_nm_rad", "zeta"])
    held = [1000.0 * held_period(design) for design in designs.to_dict("records")]
    felt = {name: own["ratio"] for name, own in rows.groupby("damping")}
    double = felt["double-diagonalization"]
    return {
        "felt_least": f"{felt['diagonal'].min():.2g}",
        "felt_most": f"{felt['diagonal'].max():.2g}",
        "double": f"{double.min():.3f} to {double.max():.3f}",
        "practice_tick": f"{min(held):.2g} to {max(held):.2g}",
    }


def held_period(design):
    """Return the period [s] at which |z| reaches 1 in a loop whose command is held, by the matrix exponential."""
    stiffness = design["stiffness_n_m"], design["stiffness_nm_rad"]
    hand = hand_of(str(design["arm"]), str(design["variation"]))
    P, Q = hand_matrices(hand, str(design["damping"]), stiffness, design["zeta"])
    still, moves = np.zeros((6, 6)), np.eye(6)
    plant = np.block([[still, moves, still], [still, still, moves], [still, still, still]])

    def excess(period):
        step = expm(period * plant)[:12]
        return np.abs(np.linalg.eigvals(step[:, :12] - step[:, 12:] @ np.hstack([P, Q]))).max() - 1.0

    return brentq(excess, 1e-5, 1.0)


def share(passes):
    """Return the percent with Wilson's interval, rounded, and n."""
    low, high = binomtest(int(passes.sum()), len(passes)).proportion_ci(0.95, method="wilson")
    return [*(round(100 * value) for value in (passes.mean(), low, high)), len(passes)]


def lead_on_arms(passes):
    """Return who passes most of a row a start and a column a controller, and how many McNemar's test ties with it."""
    first = min(passes, key=lambda name: (-passes[name].mean(), name))
    alone = [((passes[first] & ~own).sum(), (own & ~passes[first]).sum()) for _, own in passes.items()]
    tied = [a + b == 0 or binomtest(a, a + b).pvalue >= 0.05 for a, b in alone]
    return [*([sum(tied)] if sum(tied) > 1 else []), word(first.partition("@")[0]), *share(passes[first])]


def recompute_arms():
    rows = table("episodes").query("task == 'arm-regulation' and start_set == 'uniform' and variation == 'nominal'")
    rows = rows[~rows["regulator"].isin(("joint-pd", "resolved-rate"))]
    rows = rows.assign(settled=rows["outcome"] == "settled", by=rows["law"] + "@" + rows["jacobian"])
    said = [*lead_on_arms(rows.pivot(index=["arm", "kp", "start_id"], columns="by", values="settled"))]
    gains = rows.groupby("arm")["kp"].nunique()
    said += [*(tasks.arm(arm).title for arm in gains.index[gains < 3]), "three"]
    wide = rows.assign(kind=rows["kp"].map({25.0: "Kp = 25", 100.0: "Kp = 100"}).fillna("shipped"))
    wide = wide.pivot(index=["arm", "start_id", "by"], columns="kind", values="settled").dropna().astype(float)
    for kind in ("Kp = 100", "Kp = 25", "shipped"):
        said += [round(100 * wide[kind].mean()), kind]
    said.append(round(100 * (rows.loc[~rows["settled"], "range_excess_rad"] > 0).mean()))
    by_arm = rows.groupby("arm")["settled"].mean().sort_values()
    for arm in (by_arm.index[0], by_arm.index[-1]):
        said += [tasks.arm(arm).title, round(100 * by_arm[arm])]
    return {"advised": word(advised.arms().decide()[0]), "lead": said}


def torque_ratios_at_pole():
    """Return how many times the torque of (2.2) on the rotation matrix (3.7) needs past the pole, of each move."""
    rows = table("episodes").query("task == 'arm-regulation' and start_set == 'pole' and variation == 'ideal-motors'")
    by = rows["law"] + "@" + rows["jacobian"]
    usual = rows["inverse"] == np.where(rows["arm"] == "panda", "pseudo-inverse", "solve")
    rows = rows.assign(by=by)[usual & by.isin((f"{FEEDBACK}@analytic", f"{MATRIX}@geometric"))]
    torque = rows.pivot(index=["arm", "start_id"], columns="by", values="peak_torque_ratio")
    return (torque[f"{FEEDBACK}@analytic"] / torque[f"{MATRIX}@geometric"]).to_numpy()


def recompute_torque_at_pole():
    """Return the median ratio of the moves."""
    ratios = np.sort(torque_ratios_at_pole())
    return {"harder": [float(f"{np.median(ratios):.2g}")]}


def is_right(own):
    """Return whether nothing is said against a function: every answer stands for the rotation that was asked for."""
    silent, at = own["raised"] + own["not_finite"], own["distance_rad"] == 0.0
    long_way = own["long_way"].where(own["turn_error_rad"] > 0.1, 0)
    bad = silent.sum() + own.loc[at, "nought"].sum() + long_way.sum() + own["astray"].sum() + own["other_sheet"].sum()
    bound = 4.0 * 2.0**-22 if own["precision"].iloc[0] == "single" else COUNT_RAD
    return bad == 0 and own["turn_error_rad"].max() <= bound


def recompute_libraries():
    loops = table("closed_loop", "libraries").query("library != 'orientation-bench' and kind == 'function'")
    at = loops[loops["angle_deg"] == 180].groupby(["library", "function"])[["dead", "starts"]].sum()
    below = loops[loops["angle_deg"] < 180].groupby(["library", "function"])["away"].sum()
    asked = table("libraries", "libraries").query("library != 'orientation-bench' and form != 'z-y-x'")
    good = asked.groupby(["kind", "library", "function"])[list(asked)].apply(is_right)
    return {
        "loops": len(at),
        "loops_dead": (at["dead"] == at["starts"]).sum(),
        "loops_away": (below > 0).sum(),
        "functions": len(good["function"]),
        "right": good["function"].sum(),
        "idioms": len(good["idiom"]),
        "idioms_wrong": (~good["idiom"]).sum(),
        "libraries": len(set(read_json("libraries/provenance.json")["libraries"]) - {"orientation-bench"}),
    }


def recompute_times():
    share = shares_of_time().loc[lambda own: ~own.index.str.contains("literal/zyx")]
    three = share[[MATRIX, LINEARIZED, FEEDBACK]]
    found = {"matrix": share[MATRIX], "late": share[LATE], "most": share.max()}
    said = {f"time_{name}": [float(f"{value:.2g}")] for name, value in found.items()}
    said["time_most_law"] = word(share.idxmax())
    is_papers = (three.idxmin(), three.idxmax()) == (MATRIX, FEEDBACK)
    said["paper_order"] = [word(three.idxmin()), word(three.idxmax())]
    said["paper_order"] += ["as the paper" if is_papers else "other than the paper"]
    return said


def settle(push, kp, kv):
    """Return the longest time in which angles from rest come within 2 % to stay, by steps of 0.1 ms."""
    angles, h = np.linspace(1e-3, np.pi, 25), 1e-4
    theta, rate, last = angles.copy(), np.zeros(25), np.zeros(25)
    for tick in range(20_000):
        middle = theta + h / 2 * rate, rate + h / 2 * push(theta, rate, kp, kv)
        theta, rate = theta + h * middle[1], rate + h * push(*middle, kp, kv)
        last = np.where(np.abs(theta) > 0.02 * angles, (tick + 1) * h, last)
    return last.max()


def brake_late(theta, rate, kp, kv):
    """Return the acceleration by a spring of sin(theta/2), stiffened by 1 + cos²(theta/2), and an eased damper."""
    e = np.sin(theta / 2)
    return -((2 - e**2) * kp + 0.8 * kv * np.maximum(0, -e * rate)) * e - kv * rate


def recompute_new_law():
    kvs = {ratio: 20.0 * ratio for ratio in (0.5, 0.7, 1.0, 1.5)}
    late, linear = (
        {ratio: settle(push, 100.0, kv) for ratio, kv in kvs.items()}
        for push in (brake_late, lambda theta, rate, kp, kv: -kp * theta - kv * rate)
    )
    rows = table("situations", "situations").query("period == 0.01 and inertia == 1")
    rows = rows[np.isinf(rows["bound"]) & (rows[["delay", "unevenness", "spin", "jump"]] == 0.0).all(axis=1)]
    fails = rows.groupby("law")[["lost", "stuck"]].sum().any(axis=1)
    times = (rows["time"] * np.sqrt(rows["peak"])).groupby(rows["law"]).min()[~fails]
    others = times[[not is_ours(law) for law in times.index]]
    as_fast = (others <= times[LATE]).sum()
    assert as_fast == 0  # the sentence names the best of the others then
    said = [99, f"{times[LATE]:.2f}", len(others), f"{others.min():.2f}"]
    roots, calls = costs().loc[LATE, "sqrt"], operations(LATE)[1]
    return {
        "slowest": f"{late[1.0]:.3f}",
        "linear": f"{linear[1.0]:.3f}",
        # the ratios at which it is later, then the others
        "later": sorted(kvs, key=lambda ratio: late[ratio] <= linear[ratio] + 1e-3),
        "later_of": [*kvs],
        "pull": f"{brake_late(-np.linspace(0, np.pi, 100_001), 0.0, 1.0, 2.0).max():.2f}",
        "at_peak": said,
        "operations": [operations(LATE)[0], {1: "one square root"}[roots], {0: "no trigonometric function"}[calls]],
    }

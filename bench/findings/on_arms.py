"""Which controllers turn an arm's tool within what its motors are rated for and its joints can turn, and which tie.

Three measures of an episode, each with those before it:

    settled    by the judge; where the start commands a motion too, the tool is also within IN_PLACE_M of its goal
    torque     and no motor ever gave more than FULL of its rated torque
    range      and no joint ever at the end of its range

The arm as it is cuts torques and stops joints; the ideal one does neither, and records both.

Two controllers are compared on the starts that both ran. They are distinguished if so many of the starts at which one
alone passes are one's that a fair coin gives as many with less than P_VALUE, both sides (McNemar's test, exact). The
best are the one that passes most and all that are not distinguished from it: several are a tie, which nobody wins.
"""

import pandas as pd

P_VALUE = 0.05
IN_PLACE_M = 1e-3
"""[m]: a hundredth of the shortest way that a start commands, as 2 % of the turn is the judge's band."""

FULL = 0.99  # a motor that is slow comes near its rated torque, and not to it
MEASURES = ("settled", "torque", "range")
START = ["arm", "kp", "start_set", "start_id"]


def passed(rows: pd.DataFrame) -> pd.DataFrame:
    """Whether each episode passes each of MEASURES. Rows of episodes.parquet on arms; a measure that is null fails."""
    settled = rows["outcome"].astype(str) == "settled"
    if "position_left_m" in rows:
        settled &= (rows["start_set"].astype(str) != "reach") | (rows["position_left_m"] <= IN_PLACE_M)
    torque = settled & (rows["peak_torque_ratio"] <= FULL)
    return pd.DataFrame({"settled": settled, "torque": torque, "range": torque & (rows["range_excess_rad"] <= 0.0)})


def differs_significantly(one: pd.Series, other: pd.Series) -> bool:
    """Whether two controllers differ by more than chance; whether each passes, by start."""
    from scipy.stats import binomtest  # takes a second, and few commands ask it

    both = pd.concat([one, other], axis=1, join="inner").to_numpy(bool)
    ones, others = int((both[:, 0] & ~both[:, 1]).sum()), int((~both[:, 0] & both[:, 1]).sum())
    return ones + others > 0 and bool(binomtest(ones, ones + others).pvalue < P_VALUE)


def best(rows: pd.DataFrame, measure: str, by: str) -> list[str]:
    """Return the controllers (column `by`) that no other is better than: the one that passes most first, or by name."""
    rows = rows.assign(passes=passed(rows)[measure])
    of = {str(name): own.set_index(START)["passes"] for name, own in rows.groupby(by, observed=True)}
    ranked = sorted(of, key=lambda name: (-of[name].mean(), name))
    unbeaten = ranked[:1]
    for name in ranked[1:]:
        if not differs_significantly(of[ranked[0]], of[name]):
            unbeaten.append(name)
    return unbeaten

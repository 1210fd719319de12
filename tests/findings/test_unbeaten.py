"""What is said of the advised law, computed again from situations.parquet and pairs.parquet by other code."""

import collections
import math

import numpy as np
import pandas as pd
import pytest
from scipy.stats import beta, norm
from support.advised import is_ours
from support.map_rule import (
    NOTABLE,
    SPOKEN,
    is_of_draw,
    map_rows,
    map_verdicts,
    shares_of,
    slower_pairs,
    widest,
)
from support.tables import table

from bench.experiments.tables.run import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings.selection import reset, sensitivity, unbeaten, words
from bench.findings.selection.pairs import compare_times, find_slower
from bench.findings.selection.regions import find_default, find_regions
from bench.findings.selection.unbeaten import Rival, SituationShare, SituationStanding
from tasks.situation import COORDINATES

DEFAULT = widest()[0][0]
LAWS = [law for law, *_ in widest()]
NOMINAL = {name: coordinate.nominal for name, coordinate in COORDINATES.items()}


def test_default_is_the_law_of_the_widest_region():
    assert find_default() == DEFAULT


@pytest.mark.parametrize("law", [*LAWS, "late-braking", "rotation-matrix"])
@pytest.mark.parametrize("tie", [NOTABLE, SPOKEN])
def test_shares_are_those_of_the_rows_and_pairs(law, tie):
    counts = shares_of(law, tie)
    for name, share in unbeaten.measure_shares(law, tie=tie)._asdict().items():
        assert tuple(share) == (counts.get(name, 0), counts["of"]), name


def test_share_among_all_is_never_above_the_share_among_the_qualified():
    for law in LAWS:
        shares = unbeaten.measure_shares(law)
        assert shares.all.number <= shares.qualified.number <= shares.qualified.of - shares.failing.number


def test_share_of_a_region_is_the_share_among_the_qualified():
    for region in find_regions():
        assert region.unbeaten == unbeaten.measure_shares(region.law).qualified.value


def test_interval_of_a_share_is_exact():
    low, high = SituationShare(7, 30).interval
    assert (low, high) == pytest.approx((beta.ppf(0.025, 7, 24), beta.ppf(0.975, 8, 23)))


def test_laws_are_qualified_or_excluded_by_their_rows():
    rows = map_rows()
    rows = rows[[is_of_draw(at) for at in rows[[*COORDINATES]].itertuples(index=False, name=None)]]
    anywhere = rows.groupby("law")["qualified"].any()
    population = unbeaten.find_population()
    assert set(population.qualified) == {law for law, has in anywhere.items() if has and not is_ours(law)}
    assert set(population.excluded) == {law for law, has in anywhere.items() if not has and not is_ours(law)}


@pytest.mark.parametrize("among_all", [False, True])
def test_bounds_along_lines_are_those_of_the_rows_and_pairs(among_all):
    rows, slower = map_rows(), slower_pairs(SPOKEN)
    bounds = unbeaten.find_bounds(DEFAULT, among_all)
    for name in COORDINATES:
        others = [other for other in COORDINATES if other != name]
        line = rows[(rows[others] == [NOMINAL[other] for other in others]).all(axis=1)]
        expected = []
        for word, own in line.groupby("word"):
            own = own.set_index("law")
            faster = [other for other in own.index if not is_ours(other) and (word, DEFAULT, other) in slower]
            faster = [other for other in faster if among_all or own["qualified"][other]]
            expected.append((own[name].iloc[0], bool(own["qualified"][DEFAULT] and not faster)))
        assert bounds[name] == sorted(expected)


def test_law_that_is_faster_along_a_line_is_named_with_its_share():
    pairs = table("pairs", "situations")
    for name, places in unbeaten.follow_lines(DEFAULT, tie=SPOKEN).items():
        for place in places:
            for rival in place.standing.rivals:
                word = "_".join(f"{value:g}" for value in (NOMINAL | {name: place.value}).values())
                is_pair = (pairs["situation"] == word) & pairs["law"].isin((DEFAULT, rival.law))
                [row] = pairs[is_pair & pairs["other"].isin((DEFAULT, rival.law))].to_dict("records")
                ratio = row["log_ratio"] if row["other"] == DEFAULT else -row["log_ratio"]
                assert rival.faster == pytest.approx(1.0 - math.exp(ratio), abs=1e-6)
                assert rival.faster > SPOKEN


def test_sentence_of_shares_has_both_sets_and_the_exclusion():
    near, close = shares_of(DEFAULT, SPOKEN), shares_of(DEFAULT, NOTABLE)
    said = words.describe_shares(DEFAULT)
    percents = [
        f"{100 * counts[name] / counts['of']:.0f} %" for counts in (near, close) for name in ("qualified", "all")
    ]
    phrases = (f"In {percents[0]} of", f"share is {percents[1]}", f"{percents[2]} and {percents[3]}")
    places = [said.index(phrase) for phrase in phrases]
    assert places == sorted(places)
    assert f"{len(unbeaten.find_population().excluded)} of these laws fail a requirement in every situation" in said
    losing = f"{100 * near['losing'] / near['of']:.0f} %"
    assert f"In {losing} of the situations, the law itself never settles from some starts" in said


def test_price_is_that_of_the_nominal_and_the_drawn_rows():
    rows = map_rows()
    rows = rows[rows["law"] == DEFAULT]
    nominal = rows[(rows[[*NOMINAL]] == [*NOMINAL.values()]).all(axis=1)].iloc[0]
    drawn = rows[[is_of_draw(at) for at in rows[[*COORDINATES]].itertuples(index=False, name=None)]]
    price = unbeaten.find_price(DEFAULT)
    assert price.peak == nominal["peak"]
    assert price.at_equal_peak == pytest.approx(nominal["time"] * math.sqrt(nominal["peak"]))
    assert price.typical_overshoot == drawn["overshoot"].median()
    assert f"up to {nominal['peak']:.1f} kp" in words.describe_price(DEFAULT)
    assert f"in {nominal['time'] * math.sqrt(nominal['peak']):.1f}/√peak" in words.describe_price(DEFAULT)


def test_family_of_the_correction_has_every_finite_comparison_of_the_advised_law():
    pairs = table("pairs", "situations")
    advised = {"_".join(f"{value:g}" for value in at): law for at, (law, *_) in map_verdicts().items() if law}
    law = pairs["situation"].map(advised)
    family = pairs[((pairs["law"] == law) | (pairs["other"] == law)) & np.isfinite(pairs["log_ratio"])]
    sign = np.where(family["law"] == law[family.index], 1.0, -1.0)
    ratio, error = sign * family["log_ratio"].astype(float), family["error"].astype(float).clip(lower=1e-12)
    p = pd.Series(2.0 * norm.sf((ratio / error).abs())).where(family["error"].notna().to_numpy(), 1.0).sort_values()
    limits = 0.05 / np.arange(len(p), 0, -1)
    kept = p.index[: next((i for i, ok in enumerate(p.to_numpy() <= limits) if not ok), len(p))]
    different = ratio.to_numpy()[kept]
    found = sensitivity.correct()
    assert found.compared == len(family)
    assert found.different == len(kept)
    assert found.won == (different < math.log(1.0 - NOTABLE)).sum()
    assert found.lost == (different > -math.log(1.0 - NOTABLE)).sum()


def test_held_out_situations_are_rated_by_their_own_rows():
    truth = map_verdicts("situations/held-out")
    slower = slower_pairs(NOTABLE, "situations/held-out")
    rows, counts, longer = map_rows("situations/held-out"), collections.Counter(), []
    for word, own in rows.groupby("word"):
        own = own.set_index("law")
        law, unbeaten_laws, *_ = truth[tuple(own[[*COORDINATES]].iloc[0])]
        if law is None:
            continue
        faster = [other for other in own.index if not is_ours(other) and (word, DEFAULT, other) in slower]
        meets = own["qualified"][DEFAULT]
        counts["qualified"] += meets and not any(own["qualified"][other] for other in faster)
        counts["all"] += meets and not faster
        longer.append(own["time"][DEFAULT] / min(own["time"][other] for other in unbeaten_laws) - 1.0)
    default = sensitivity.count_agreeing().default
    assert (default.qualified.number, default.all.number) == (counts["qualified"], counts["all"])
    assert default.half == pytest.approx(np.quantile(longer, 0.5, method="inverted_cdf"))
    assert default.qualified.of == rows["word"].nunique()


def test_laws_of_ours_are_in_neither_set():
    for standing in unbeaten.compare_everywhere(DEFAULT).values():
        assert not any(is_ours(rival.law) for rival in standing.rivals)


def test_law_that_fails_a_requirement_is_not_unbeaten():
    free = SituationStanding(True, 0, (Rival("gibbs", 0.1, False),))
    assert free.is_unbeaten(among_all=False)
    assert not free.is_unbeaten(among_all=True)
    assert not free._replace(meets=False, rivals=()).is_unbeaten(among_all=False)


def test_laws_that_differ_on_common_starts_alone_are_told_apart():
    rng = np.random.default_rng(5)
    hard = rng.gamma(2.0, size=2048)  # how hard a start is, for both laws
    times = {"a": 1.0 + hard, "b": 1.07 * (1.0 + hard)}
    [pair] = compare_times(times)
    assert pair["log_ratio"] == pytest.approx(-math.log(1.07))
    assert pair["high"] < 0.0
    slower = find_slower(pd.DataFrame([pair]), ["b", "a"], NOTABLE)
    assert slower.tolist() == [[False, True], [False, False]]
    unpaired = {"a": times["a"], "b": 1.07 * (1.0 + rng.gamma(2.0, size=2048))}
    [pair] = compare_times(unpaired)
    assert pair["low"] < 0.0 < pair["high"]


def test_laws_are_compared_over_the_starts_that_both_ran():
    times = np.linspace(1.0, 2.0, 1024)[::-1]
    [pair] = compare_times({"a": times, "b": times[:512]})
    assert (pair["starts"], pair["log_ratio"], pair["error"]) == (512, 0.0, 0.0)


def test_pair_of_laws_that_never_settle_has_no_row():
    never = np.full(512, math.inf)
    assert compare_times({"a": never, "b": never}) == []
    [pair] = compare_times({"a": never, "b": np.ones(512)})
    assert pair["log_ratio"] == math.inf
    assert pair["low"] == math.inf
    assert math.isnan(pair["error"])


def test_reset_is_said_with_its_way_and_its_time():
    rows = table("perturbed", "robustness").query("law == @DEFAULT and 0 < level <= 0.2")
    for axis in ("goal-jump", "goal-jump-reset"):
        own = rows[rows["axis"] == axis]
        share = f"{100 * own['long'].sum() / own['far'].sum():.1f} %"
        assert share in reset.describe_resets(DEFAULT)
        assert f"{own['median_s'].max():.3f} s" in reset.describe_resets(DEFAULT)


def test_resets_of_a_run_are_paired_by_start():
    rows = with_contender(pd.read_parquet(RESULTS / "reference" / "robustness.parquet"))
    pairs = reset.pair_resets(rows, DEFAULT)
    one = table("robustness").query("law == @DEFAULT and 0 < level <= 0.2")
    axes = ("goal-jump", "goal-jump-reset")
    kept, again = (one[one["axis"] == axis].set_index(["level", "start_id"]) for axis in axes)
    delays = again["settling_time_s"] - kept["settling_time_s"]
    assert (pairs.pairs, pairs.differ, pairs.later) == (len(kept), (delays != 0.0).sum(), (delays > 0.0).sum())
    assert pairs.shorter == (again["path_ratio"] < kept["path_ratio"])[delays != 0.0].sum()

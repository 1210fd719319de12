"""What was not tested is neither passed nor failed: planted tables that lack a row, and claims at each gain."""

import math

import pandas as pd
import pytest

from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import Estimate
from bench.findings.claims import adequacy
from bench.findings.claims.at_gains import at_every_gain, weakest_at_every_gain
from bench.findings.claims.standing import Ledger, Operations
from bench.findings.claims.verdict import Evidence, Word
from bench.findings.maps import Spun, spun
from bench.law.inputs import Gains

EVERY_SPIN_SETTLES = (Spun(20.0, 10_000, 0, Estimate(0.0, 0.0, 4e-4)),)
EVERY_SPIN_IS_LOST = (Spun(20.0, 10_000, 0, Estimate(1.0, 0.99, 1.0)),)
HELD_BY_NONE = {"hybrid": (0, 12)}
LEDGER = Ledger([], ({"hybrid": Operations(60, 0), "a": Operations(70, 3), "b": Operations(80, 3)},), math.nan)


def law(**changed):
    """Return a law that passes every test, but for what is changed."""
    usual = {
        "name": "hybrid",
        "n": 1000,
        "settled": 1.0,
        "pace": Estimate(0.6, 0.6, 0.6),
        "directed": 100,
        "lost": 0,
        "exact": 10,
        "lost_exact": 0,
        "spun": EVERY_SPIN_SETTLES,
        "detour": 1.0,
        "cost": Operations(60, 0),
        "rows": 1000,
    }
    return adequacy.Adequacy(**{**usual, **changed})


def examined(held=HELD_BY_NONE, ledger=LEDGER, **changed):
    return adequacy.examine(law(**changed), ledger, 0.58, held, on_angles=("a", "b"))


def test_law_with_every_row_passes():
    assert examined().passes


@pytest.mark.parametrize(
    ("test", "lacking"),
    [
        ("b", {"spun": ()}),
        ("b", {"spun": (Spun(0.0, 10_000, 0, Estimate(0.0, 0.0, 4e-4)),)}),  # at rest alone
        ("b", {"directed": 0}),
        ("e", {"exact": 0}),
        ("f", {"held": {}}),
        ("g", {"detour": math.nan}),
    ],
)
def test_row_that_is_missing_is_not_tested_and_not_failed(test, lacking):
    tested = examined(**lacking)
    assert tested.untested == {test}
    assert not tested.failed
    assert tested.may_pass
    assert not tested.passes
    assert str(tested) == f"not tested: {test}"


def test_cost_that_nothing_decides_is_not_tested():
    counts = {"hybrid": Operations(60, 1), "a": Operations(50, 3), "b": Operations(80, 3)}
    assert examined(ledger=Ledger([], (counts,), math.nan)).untested == {"d", "h"}
    dearer = {"hybrid": Operations(90, 4), "a": Operations(50, 3), "b": Operations(80, 3)}
    assert examined(ledger=Ledger([], (dearer,), math.nan)).failed == {"d", "h"}


def test_failure_decides_though_another_row_is_missing():
    tested = examined(spun=(), lost=50)
    assert (tested.failed, tested.untested) == ({"b"}, frozenset())
    assert examined(spun=EVERY_SPIN_IS_LOST).failed == {"b"}


def test_spins_are_of_the_run_s_gains_and_engine_and_no_other():
    row = {"contender": "hybrid", "kp": 100.0, "kv": 20.0, "engine": "ideal-rk4"}
    row |= {"least_speed": 20.0, "most_speed": 20.0, "starts": 40_000, "lost": 7, "unconverged": 0}
    other = row | {"kv": 10.0, "starts": 10_000, "lost": 0}
    counts = pd.DataFrame([row, other])
    [at_20] = spun(counts, "hybrid", Gains(100.0, 20.0), "ideal-rk4")
    [at_10] = spun(counts, "hybrid", Gains(100.0, 10.0), "ideal-rk4")
    assert (at_20.starts, at_10.starts) == (40_000, 10_000)
    assert at_20.share.value == 7 / 40_000
    assert at_10.share.value == 0.0
    assert spun(counts, "hybrid", Gains(100.0, 16.0), "ideal-rk4") == []
    assert spun(counts, "hybrid", Gains(100.0, 20.0), "ideal-held") == []


class Decided(Run):
    """A run of which only the gains and the word are known."""

    def __init__(self, kv, word):
        super().__init__(None)
        self.kv, self.word = kv, word

    def gains(self):
        return Gains(100.0, self.kv)


def decide(run):
    return run.word, Evidence(f"kv {run.kv:g}", 1, (), f"true at {run.kv:g}")


def asked(wrapper, own, *others):
    own.others = others
    return wrapper(decide)(own)


def test_gains_at_which_it_was_not_tested_give_no_word_and_are_named():
    others = [Decided(10.0, Word.HOLDS), Decided(20.0, Word.HOLDS)]
    word, said = asked(at_every_gain, Decided(16.0, Word.UNTESTED), *others)
    assert word == Word.HOLDS
    assert "At Kp = 100, Kd = 16, the verdict is 'not tested'." in said.sentence
    assert asked(at_every_gain, Decided(16.0, Word.UNTESTED), Decided(20.0, Word.UNTESTED))[0] == Word.UNTESTED


def test_word_is_the_same_from_any_run_and_its_own_rows_come_first():
    others = [Decided(10.0, Word.FAILS), Decided(20.0, Word.CORRECTED)]
    for own in (Decided(10.0, Word.FAILS), Decided(16.0, Word.FAILS), Decided(20.0, Word.CORRECTED)):
        word, said = asked(at_every_gain, own, *others)
        assert word == Word.DEPENDS
        assert said.sentence.count(f"Kd = {own.kv:g}, the verdict") == 1


def test_weakest_word_of_all_gains_is_the_claim_s():
    word, said = asked(weakest_at_every_gain, Decided(20.0, Word.HOLDS), Decided(10.0, Word.CORRECTED))
    assert word == Word.CORRECTED
    assert said.instead == "At Kp = 100, Kd = 10: true at 10 At Kp = 100, Kd = 20: true at 20"

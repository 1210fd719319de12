"""Every claim on tables as theory has them or of the committed run: what follows if something is planted there."""

import itertools
import re
import tomllib
from pathlib import Path

import pandas as pd
import pytest
from support.claim_tables import TABLES, contact, reference
from support.tables import changed, decided, judged, look_up

from bench.base.errors import NoEvidence
from bench.base.files import read_json
from bench.experiments.tables.run import Run, with_contender
from bench.findings.claims import side_by_side
from bench.findings.claims.controller_costs import BY_COMMON, BY_EULER, ON_MATRIX, words
from bench.findings.claims.verdict import Word
from bench.findings.conclusions import read_texts, weakest_word
from bench.studies.verdicts import STORED

DATA = tomllib.loads(Path(__file__).with_name("planted_claims.toml").read_text(encoding="utf-8"))
LATER = ("quaternion-shortest", "hybrid")


def tables(id):
    """Return the tables that a claim is judged on."""
    return TABLES[id]()


def as_base(frames, rows):
    """Give the chosen rows of Euler coordinates the compliance of hybrid-base at the same poses."""
    t, key, cells = frames["compliance"].copy(), ["arm", "form", "pose"], [*side_by_side.MEASURED, "outcome"]
    base = t[t["controller"] == "hybrid-base"].set_index(key)
    chosen = look_up(t, rows)
    t.loc[chosen, cells] = base.loc[t.loc[chosen, key].itertuples(index=False, name=None), cells].to_numpy()
    return {"compliance": t}


def scaled(frames, factor):
    """Make one pose no turned axis."""
    t, cells = frames["compliance"].copy(), list(side_by_side.MEASURED)
    chosen = look_up(
        t, "at == '35 45 -20' and complies == 'about y' and representation == 'zyx-euler' and arm == 'ur5e'"
    )
    t.loc[chosen, cells] *= float(factor)
    return {"compliance": t}


def native(frames, _):
    """Add a law that an engine ran and on which noise was not tried."""
    own = {name: frames[name][frames[name]["regulator"] == LATER[0]] for name in ("episodes", "costs")}
    own = {name: rows.assign(regulator="mine", contender="mine") for name, rows in own.items()}
    own["episodes"] = own["episodes"].assign(engine="native")
    return {name: pd.concat([frames[name], rows]) for name, rows in own.items()}


FUNCTIONS = {
    "as_base": as_base,
    "scaled": scaled,
    "native": native,
    "alike": lambda frames, _: contact(is_apart=False),  # no pair parts
    "mine": lambda frames, _: {name: rows.replace(LATER[0], "mine") for name, rows in frames.items()},
    "empty": lambda frames, _: {name: frame.iloc[:0] for name, frame in frames.items()},
}


def edit(frames, text):
    """Return the tables after an edit."""
    name, _, rest = (part.strip() for part in text.partition(":"))
    if name in FUNCTIONS:
        return frames | FUNCTIONS[name](frames, rest)
    rows, _, cells = (part.strip() for part in rest.partition("->"))
    frame, chosen = frames[name], look_up(frames[name], rows)
    if not cells:
        return frames | {name: frame[chosen]}
    values = dict(cell.split(" = ") for cell in cells.split("; "))
    given = {column: look_up(frame, value) for column, value in values.items()}
    given = {column: value[chosen] if isinstance(value, pd.Series) else value for column, value in given.items()}
    return frames | {name: changed(frame, chosen, **given)}


def planted(id, *edits):
    """Return the verdict on a claim's tables after edits: texts, or functions of the tables."""
    frames = tables(id)
    for one in edits:
        frames = edit(frames, one) if isinstance(one, str) else frames | one(frames)
    return judged(id, **frames)


def written(evidence):
    """Return the sentence of an evidence and its numbers, a row a line, cells between bars."""
    return "\n".join([evidence.sentence, *(" | ".join(row) for row in evidence.numbers)])


def write_out(text):
    """Return a text with the words under `short` in the place of their names."""
    while marks := set(re.findall(r"\{(\w+)\}", text)):
        for word in marks:
            text = text.replace(f"{{{word}}}", DATA["short"][word])
    return text


def each_of(case):
    """Yield a case once for each of what it has in angle brackets."""
    names = sorted(set(re.findall(r"<(\w+)[.>]", "\n".join(case))))
    for chosen in itertools.product(*(DATA["each"][name] for name in names)):
        made = case
        for name, word in zip(names, chosen, strict=True):
            every = DATA["each"][name]
            made = [text.replace(f"<{name}>", word) for text in made]
            made = [text.replace(f"<{name}.of>", every[word]) for text in made] if isinstance(every, dict) else made
        yield list(map(write_out, made))


EMPTY = [id for id, made in TABLES.items() if made is reference]
CASES = [(id, *one) for id, cases in DATA["cases"].items() for case in cases for one in each_of(case)]
CASES += [(id, "refused: .", "empty") for id in EMPTY]


@pytest.mark.parametrize(
    "case",
    [pytest.param(one, marks=[pytest.mark.slow] * (TABLES.get(one[0]) is reference)) for one in CASES],
    ids=lambda case: f"{case[0]}-{case[1]}",
)
def test_verdict_follows_what_is_planted(case):
    id, follows, *edits = case
    if follows.startswith("refused: "):
        with pytest.raises(NoEvidence, match=follows.removeprefix("refused: ")):
            planted(id, *edits)
    elif follows.upper() in Word.__members__:
        assert decided(planted(id, *edits), Word[follows.upper()])
    else:
        assert follows in written(planted(id, *edits).evidence)


@pytest.mark.parametrize("id", [f"C{i:02d}" for i in range(1, 18)])
def test_claim_is_decided_by_a_quick_run(id):
    verdict = planted(id)
    assert verdict.word in (Word.HOLDS, Word.CORRECTED, Word.FAILS)
    assert decided(verdict, verdict.word)


@pytest.mark.parametrize(("id", "rows"), [("C24", 4 * 2 * (2 + 1 + 2)), ("C25", 54)])
def test_claim_looks_near_zero_only_and_at_every_pair_in_contact(id, rows):
    """C24 at 0, 1, 5 and 15 degrees, on two arms, in one or two forms."""
    assert planted(id).rows == rows


OTHER = {"representation": "mrp", "condition_analytic": 8.0, "largest": 1.0, "det_gap": 1.0, "derivation_gap": 1.0}


def beside(frame):
    """Add rows that no claim of chapter 2 is about: the same laws on an arm, and in other representations."""
    spoilt = frame.assign(regulator=frame["regulator"].astype(str), representation=frame["representation"].astype(str))
    for name, value in (("outcome", "diverged"), ("flops", 0), ("atan2", 0), ("time_s", 1e3), ("fails_from_rad", 0.1)):
        if name in frame:
            spoilt[name] = value
    task = {"task": "arm-regulation"} if "task" in frame else {}
    on_arm = spoilt.assign(jacobian="geometric", inverse="solve", **task)
    together = pd.concat([on_arm, frame, spoilt.assign(representation="mrp")], ignore_index=True)
    together = with_contender(together)
    # evidence lists outcomes that are equally frequent in the order of their categories
    return together.astype({"outcome": frame["outcome"].dtype}) if "outcome" in frame else together


def in_mrp(rows):
    return pd.concat([rows, rows.assign(**OTHER)])


ADDED = {
    **{id: {"poses": in_mrp} for id in ("C18", "C19")},
    "C20": {
        "episodes": lambda rows: pd.concat(
            [rows, rows.assign(variation="mass-130", outcome="diverged")], ignore_index=True
        )
    },
    **{
        id: dict.fromkeys(("episodes", "costs", "traces", "boundaries"), beside)
        for id in ("C03", "C06", "C09", "C12", "C14", "C17")
    },
}
"""Claim -> rows that it must not look at: other coordinates, plants that differ from the model, arms."""


@pytest.mark.parametrize("id", ADDED)
def test_claim_looks_at_no_other_coordinates_plants_or_arms(id):
    among = planted(id, lambda frames: {name: added(frames[name]) for name, added in ADDED[id].items()})
    alone = planted(id)
    assert (among.word, str(among.evidence), among.rows) == (alone.word, str(alone.evidence), alone.rows)


def test_improvement_that_is_not_dramatic_at_other_gains_depends_on_them():
    slow = edit(
        reference(), "episodes: {} -> settling_time_s = 1.5 * settling_time_s".format(DATA["short"]["feedback_uniform"])
    )
    other = Run(None, {"episodes": slow["episodes"].assign(kv=10.0)})
    verdict = judged("C31", others=[other], **reference())
    assert verdict.word == Word.DEPENDS
    assert "At Kp = 100, Kd = 10:" in verdict.correction
    assert "Kd = 10, the verdict is 'does not hold'" in str(verdict.evidence)


@pytest.mark.parametrize("euler", [3000.0, 1000.0])
def test_no_time_changes_the_word_of_c26(euler):
    times = {BY_COMMON: 2000.0, ON_MATRIX: 1800.0, BY_EULER: euler}
    where = {"what": "engine", "engine": "native", "arm": "ur5e", "machine": "m", "ticks": 1, "ns_per_tick": 1.0}
    rows = [
        {**words(one, 6), **where, "ratio": time, "ratio_low": time - 50.0, "ratio_high": time + 50.0}
        for one, time in times.items()
    ]
    verdict = planted("C26", lambda frames: {"timings": pd.DataFrame(rows)})
    assert verdict.word == Word.HOLDS
    assert "times differ in 2 of the 4 pairs" in str(verdict.evidence)


STORED_WORDS = {id: Word(word) for id, word in read_json(STORED)["reference"].items()}

TURNED = [
    ("rotation-matrix", "C01", "fails", "episodes: {first} -> outcome = 'diverged'"),
    (
        "linearized-euler",
        "C37",
        "corrected",
        "episodes: {euler} and start_set == 'uniform' and number % 3 > 0 -> {lost}",
    ),
    ("feedback-linearized", "C31", "fails", "episodes: {feedback_uniform} and number % 10 == 0 -> {lost}"),
    ("cost", "C26", "fails", "costs: {by_euler} and stage == 'total' -> flops = 829"),
    ("no-regulator", "C17", "fails", "episodes: law == 'rotation-matrix' -> {fast}"),
    ("euler-jacobian", "C18", "fails", "poses: margin >= 0 -> condition_analytic = 8.0; largest = 1.0"),
    ("compliance", "C22", "corrected", "as_base: {of_euler}"),
    ("open-question", "C27", "holds", "episodes: {later} and start_set == 'uniform' -> outcome = 'stuck'"),
]
"""A conclusion, one of its claims, the word that the conclusion gets, and what is planted in the claim's tables."""


@pytest.mark.slow
@pytest.mark.parametrize(("name", "id", "follows", "edit"), TURNED, ids=lambda text: str(text).partition(":")[0])
def test_conclusion_is_turned_by_what_is_planted_in_one_of_its_claims(name, id, follows, edit):
    claims = read_texts()[name]["claims"]
    before = weakest_word(STORED_WORDS, claims)
    turned = STORED_WORDS | {id: planted(id, write_out(edit)).word}
    assert weakest_word(turned, claims) == Word[follows.upper()] != before


@pytest.mark.parametrize("name", read_texts())
def test_conclusion_is_not_tested_without_a_word_on_one_of_its_claims(name):
    claims = read_texts()[name]["claims"]
    lacking = {id: word for id, word in STORED_WORDS.items() if id != claims[-1]}
    assert weakest_word(lacking, claims) == Word.UNTESTED != weakest_word(STORED_WORDS, claims)

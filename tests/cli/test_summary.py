"""What `show` says of a run in at most 40 lines of 80 columns, by its kind, and the parts it prints in full."""

import re
from collections import Counter

import pandas as pd
import pytest
from rich.console import Console
from support.command_line import bench, python, refused
from support.tables import changed

from bench.base.files import read_json
from bench.cli import claims
from bench.cli.details import PARTS, robustness
from bench.cli.details.episodes import tables_of_arms
from bench.cli.options import REFERENCE
from bench.cli.screen import frame_table
from bench.cli.summary import answer, details, failures, laws, paper, today, whole
from bench.cli.summary.parts import list_parts
from bench.experiments.tables.run import VARIABLE, Run, choose_rows
from bench.experiments.tables.schema import RESULTS
from bench.findings.answer import advise_gains, find_answer
from bench.findings.claims import all_claims
from bench.findings.claims.adequacy import THREE
from bench.findings.claims.verdict import Evidence, Verdict, Word
from bench.findings.selection.nearest import answer as answer_nearest
from bench.findings.selection.nearest import decide_nearest
from bench.findings.selection.regions import find_default
from bench.findings.selection.run_rows import compare_free_body
from bench.law.inputs import Gains
from bench.studies.verdicts import STORED
from tasks.situation import NOMINAL

LINES, COLUMNS = 40, 80
OTHER_GAINS = RESULTS / "gains" / "kv-14"
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "PYTHONIOENCODING": None, "COLUMNS": "200"}
UNJUDGED = """
import sys
from pathlib import Path
from bench.cli.summary import paper, whole
paper.count_verdicts = lambda results: "Of 47, 1 holds."
whole.print_summary(Path(sys.argv[1]), is_named=False)
"""


@pytest.fixture(scope="module")
def tables():
    return {name: Run(REFERENCE).table(name) for name in ("episodes", "compliance", "robustness", "costs")}


@pytest.fixture(scope="module")
def reference(tables):
    return Run(REFERENCE, dict(tables))


@pytest.fixture
def judged(monkeypatch):
    """Give every run the stored words of the claims, which take half a minute to find."""
    words = {id: Word(word) for id, word in read_json(STORED)["reference"].items()}
    verdicts = [Verdict(claim, words[claim.id], Evidence("", 1)) for claim in all_claims() if claim.id in words]
    monkeypatch.setattr(paper, "judge_possible", lambda run: (verdicts, {}))
    return verdicts


def text(*found) -> str:
    return " ".join(sentence for one in found for sentence in one.sentences)


def joined(said) -> str:
    return " ".join(said.out.split())


def fits(out: str) -> bool:
    lines = out.splitlines()
    return len(lines) <= LINES and max(map(len, lines)) <= COLUMNS


@pytest.mark.weekly
def test_summary_of_the_reference_fits_the_screen(reference):
    """In a process of its own: it judges every claim, which takes memory."""
    assert fits(python("-m", "bench", "show", REFERENCE))


@pytest.mark.parametrize("folder", [REFERENCE, OTHER_GAINS])
@pytest.mark.parametrize("columns", ["80", "200", None])
def test_summary_of_a_whole_run_fits_the_screen_in_every_pipe(capsys, monkeypatch, judged, folder, columns):
    monkeypatch.delenv("COLUMNS", raising=False)
    if columns:
        monkeypatch.setenv("COLUMNS", columns)
    said = bench(capsys, "show", folder)
    assert said.code == 0
    assert fits(said.out)


@pytest.mark.parametrize("folder", [REFERENCE, OTHER_GAINS])
def test_summary_without_utf8_fits_and_spells_its_units(folder):
    out = python("-c", UNJUDGED, folder, **ASCII)
    assert fits(out)
    assert out.isascii()
    assert "?" not in out


def test_summary_has_the_paper_first_then_later_laws_then_what_to_use(capsys, judged):
    said = bench(capsys, "show", REFERENCE)
    assert said.out.startswith("Murphy (1988), replicated    kp 100 /s2, kv 20 /s, ")
    order = ("rotation-matrix ", "linearized-euler ", "feedback-linearized ", "since 1988, published", "mrp-memory ")
    order += ("Jacobian, 4 arms", "geometric ", "Euler ", "compliance ", "His claims", "Use today", "More")
    places = [re.search(f"^{re.escape(words)}", said.out, re.MULTILINE).start() for words in order]
    assert places == sorted(places)
    counts = Counter(read_json(STORED)["reference"].values())
    assert f"Of 47, {counts['holds']} hold, {counts['holds with a correction']} hold with a correction, " in joined(
        said
    )


def test_summary_names_the_law_of_the_answer_and_its_price(capsys, judged):
    said = joined(bench(capsys, "show", REFERENCE))
    need = find_answer().needs[0]
    assert need.law == find_default()
    assert f"Use today {need.law} ({need.attribution}) {need.price}" in said
    for other in find_answer().needs[1:]:
        assert f"{other.law} ({other.attribution})" in said


def test_summary_without_a_map_says_not_tested(capsys, judged, monkeypatch, tmp_path):
    nothing = find_answer(tmp_path, tmp_path)
    monkeypatch.setattr(today, "find_answer", lambda: nothing)
    monkeypatch.setattr(whole, "list_later_laws", list)
    said = joined(bench(capsys, "show", REFERENCE))
    assert "Use today Not tested: there is no map of situations" in said
    # the heading of our own laws alone has the word
    assert "advise" not in said.replace("not advised", "")


def test_run_at_other_gains_names_them_and_answers_for_them(capsys, judged):
    said = bench(capsys, "show", OTHER_GAINS)
    assert "kp 100 /s2, kv 14 /s" in said.out.splitlines()[0]
    assert f"Use today {advise_gains(Gains(100.0, 14.0))} other gains: " in joined(said)
    assert "damping ratio 0.7" in said.out
    assert "kv 20" not in said.out


@pytest.mark.parametrize(
    ("gains", "words"),
    [
        (Gains(100.0, 13.0), "(damping ratio 0.65): hybrid (published), tested at damping ratio 0.648"),
        (Gains(400.0, 40.0), "kp = 400, kv = 40 (damping ratio 1): mrp-memory (adapted)"),
        (Gains(100.0, 90.0), "(damping ratio 4.5): not tested in the map (damping ratios 0.5 to 2)"),
    ],
)
def test_advice_for_gains_is_of_their_damping_ratio(gains, words):
    assert words in advise_gains(gains)
    assert f"bench advise --kp {gains.kp:g} --kv {gains.kv:g}" in advise_gains(gains)


def test_advice_for_gains_without_a_map_says_not_tested(tmp_path):
    assert "not tested" in advise_gains(Gains(100.0, 20.0), tmp_path)


def row(tables, law, **planted):
    """Return the lines of a law of the reference with planted tables."""
    return " ".join(laws.format_row(laws.measure_law(Run(REFERENCE, {**tables, **planted}), law)))


def test_row_of_a_law_is_read_off_the_rows(tables):
    episodes = tables["episodes"]
    own = (episodes["contender"].astype(str) == "hybrid") & (episodes["engine"] == "ideal-rk4")
    uniform, noise = own & (episodes["start_set"] == "uniform"), tables["robustness"]["axis"] == "half-turn-noise"
    assert re.search(r"hybrid +100 \(98-100\) +0.63 +0.67 +none found +69 ", row(tables, "hybrid"))
    lost = changed(episodes, uniform & (episodes["beta0"].abs() > 1.0), outcome="stuck")
    assert re.search(
        r"hybrid +\d\d \(\d\d-\d\d\) +0.\d\d +never +from \d+ deg on ", row(tables, "hybrid", episodes=lost)
    )
    slow = changed(episodes, uniform, settling_time_s=3.25)
    assert " 3.25   3.25 " in row(tables, "hybrid", episodes=slow)
    held = changed(tables["robustness"], noise & (tables["robustness"]["level"] > 0.0), outcome="stuck")
    assert "trapped by noise" in row(tables, "hybrid", robustness=held)
    assert "none found* " in row(tables, "hybrid", robustness=tables["robustness"][~noise])
    long_way = changed(episodes, uniform, path_ratio=2.0)
    assert "turns the long way" in row(tables, "hybrid", episodes=long_way)
    costs = tables["costs"]
    dearer = changed(costs, costs["contender"].astype(str) == "hybrid", flops=500, sin=2)
    assert re.search(r"500\+\d+ ", row(tables, "hybrid", costs=dearer))
    assert re.search(r"none found +- ", row(tables, "hybrid", costs=costs.iloc[:0]))


def test_lines_on_jacobians_and_compliance_are_read_off_the_rows(tables):
    episodes, rows = tables["episodes"], tables["compliance"]
    geometric = episodes["contender"].astype(str).str.startswith("rotation-matrix@geometric")
    stuck = changed(episodes, geometric, outcome="stuck", peak_torque_ratio=2.0)
    _, line, _ = paper.compare_jacobians(Run(REFERENCE, {**tables, "episodes": stuck}))
    assert re.search(r"geometric +16 of 16 moves +2 +807$", line)
    turned = changed(rows, rows["misalignment_rad"].notna(), misalignment_rad=0.5)
    two, one = paper.compare_compliance(Run(REFERENCE, {**tables, "compliance": turned}))
    assert two == "Euler, two axes: turns 29 deg off at beta = 60 deg (2 arms: 29-29)"
    assert one.startswith("Euler, one axis: right axis at 29 of 102 poses, 28 % ")
    assert paper.compare_jacobians(Run(REFERENCE, {**tables, "episodes": episodes[episodes["arm"] == ""]})) == []
    assert paper.compare_compliance(Run(REFERENCE, {**tables, "compliance": rows.iloc[:0]})) == []


def some_laws(tables, *names):
    """Return a run that holds the free body's rows of some laws alone."""
    chosen = {
        name: frame[frame["contender"].astype(str).isin(names)]
        for name, frame in tables.items()
        if name != "compliance"
    }
    return Run(REFERENCE, {**chosen, "compliance": tables["compliance"].iloc[:0]})


def test_run_of_some_laws_shows_them_beside_each_other_and_judges_nothing(capsys, tables, monkeypatch):
    run = some_laws(tables, "square-root", "mrp")
    monkeypatch.setattr(whole, "Run", lambda folder: run)
    monkeypatch.setattr(paper, "judge_possible", None)  # a call would fail
    whole.print_summary(REFERENCE, is_named=True)
    out = capsys.readouterr().out
    assert fits(out)
    assert out.startswith("2 laws ")
    assert re.search(r"^mrp +100 \(98-100\) +0.56 +0.58 +4 +", out, re.MULTILINE)
    assert re.search(r"^square-root +100 \(98-100\) +0.63 +0.67 +2 +", out, re.MULTILINE)
    assert re.search(r"takes \d\.\d\d \(\d\.\d\d-\d\.\d\d\) times as long as", out)
    assert "Murphy" not in out
    assert "claims" not in out


def test_times_of_two_laws_are_compared_over_equal_starts(tables):
    episodes = tables["episodes"]
    twice = episodes[(episodes["contender"].astype(str) == "mrp") & (episodes["engine"] == "ideal-rk4")]
    twice = twice.assign(contender="mine", settling_time_s=2.0 * twice["settling_time_s"])
    run = Run(REFERENCE, {**tables, "episodes": pd.concat([episodes, twice], ignore_index=True)})
    assert whole.compare_pace(run, "mine", "mrp").startswith("mine takes 2.00 (2.00-2.00) times as long as mrp until")
    assert whole.compare_pace(run, "mine", "no-such-law") == ""


def test_run_holds_the_papers_laws_only_with_all_three(tables):
    assert paper.holds_papers_laws(some_laws(tables, *THREE))
    for law in THREE:
        assert not paper.holds_papers_laws(some_laws(tables, *(set(THREE) - {law})))


@pytest.mark.parametrize("part", ["arms", "contact", "robustness"])
def test_run_of_one_part_shows_that_part_alone(capsys, tables, monkeypatch, part):
    episodes, rows = tables["episodes"], {name: tables[name].iloc[:0] for name in ("compliance", "robustness")}
    kept = {
        "arms": {"episodes": episodes[episodes["arm"] != ""], **rows},
        "contact": {"episodes": episodes.iloc[:0], **rows, "compliance": tables["compliance"]},
        "robustness": {"episodes": episodes.iloc[:0], **rows, "robustness": tables["robustness"]},
    }[part]
    run = Run(REFERENCE, {**tables, **kept})
    monkeypatch.setattr(whole, "Run", lambda folder: run)
    monkeypatch.setattr(paper, "judge_possible", None)
    whole.print_summary(REFERENCE, is_named=True)
    out = capsys.readouterr().out
    assert fits(out)
    assert out.startswith(part.capitalize())
    assert {"arms": "settles   50 %", "contact": ", done: ", "robustness": "perturbations of"}[part] in out
    assert ("Use today" in out) == (part != "contact")


def test_summary_of_a_tiny_run_fits_too_says_what_is_not_in_it_and_offers_what_works(capsys, finished, monkeypatch):
    monkeypatch.chdir(finished.parent)
    said = bench(capsys, "show", finished.name)
    assert fits(said.out)
    assert said.out.startswith("1 law ")
    assert re.search(r"^rotation-matrix +0 of 3 +never +never ", said.out, re.MULTILINE)
    assert "not in it: arms, contact, robustness" in joined(said)
    offered = re.findall(r"bench (show .*--details)", said.out)
    assert offered == [f"show {finished.name} --details"]
    more = bench(capsys, *offered[0].split())
    assert (more.code, "There is nothing" in more.out) == (0, False)
    judged = bench(capsys, "claims", finished.name)
    assert re.search(r"^Not judged {3}C01 cannot be judged from this run: no episode", judged.out, re.MULTILINE)


def test_claims_end_with_how_many_hold_by_the_first_criteria_too(judged):
    sentences = claims._count(judged).sentences
    assert sentences[0].startswith("Of 47 claims ")
    assert sentences[1] == "What does not hold: C37."
    assert sentences[2].startswith("By the criteria first written: ")


def test_summary_imports_no_statistics_of_scipy():
    code = "import sys, bench.cli.summary.whole; print('scipy.stats' in sys.modules)"
    assert python("-c", code).strip() == "False"


def test_laws_of_a_run_without_arms_are_compared(tables):
    episodes, compliance = choose_rows(tables["episodes"], {"arm": ""}), tables["compliance"].iloc[:0]
    run = Run(REFERENCE, {**tables, "episodes": episodes, "compliance": compliance})
    said = text(*answer.paragraphs(compare_free_body(run)))
    assert "In this run, 99 % of the uniform starts settle within 0.584 s with late-braking" in said
    assert "by our rule, the two laws tie. late-braking meets our requirements here." in said


def test_details_have_the_advice_and_the_failures_in_sentences(capsys, monkeypatch):
    monkeypatch.setattr(details, "compare_free_body", lambda run: None)
    said = bench(capsys, "show", REFERENCE, "--details")
    for head in ("Which law", "Elsewhere", "Ours", "Other rules", "What failed"):
        assert re.search(f"^{head} ", said.out, re.MULTILINE)
    assert f"Use the law {find_default()} (adapted: after" in said.out


def test_settled_counts_are_those_of_the_tables(tables, reference):
    episodes = tables["episodes"]
    free_body = episodes[episodes["arm"] == ""]
    settled = (free_body["outcome"] == "settled").sum()
    assert f"Free body: settled {settled:,} of {len(free_body):,} episodes" in text(failures.paragraph(reference))


def test_law_that_broke_is_named(tables):
    lost = tables["episodes"].head(3).assign(outcome=pd.Categorical(["crashed", "hung", "crashed"]))
    law = str(lost["contender"].iloc[0]).partition("@")[0]
    said = text(failures.paragraph(Run(REFERENCE, {**tables, "episodes": lost})))
    assert f"{law} crashed in 2 episodes and {law} hung in 1 episode" in said


@pytest.mark.parametrize("part", PARTS)
def test_part_is_shown_alone_with_the_meaning_of_its_cells(capsys, part):
    said = bench(capsys, "show", REFERENCE, part)
    heads = re.findall(r"^(.*\(a/b: .*)", said.out, re.MULTILINE)
    assert said.code == 0
    assert heads
    assert len(re.findall(r"^(?:law|controller) ", said.out, re.MULTILINE)) == len(heads)
    assert all({"free-body": "free body", "robustness": "robustness"}.get(part, "") in head for head in heads)


def test_details_are_all_parts(capsys, reference):
    whole = bench(capsys, "show", REFERENCE, "--details").out
    for part in list_parts(reference):
        assert bench(capsys, "show", REFERENCE, part).out.split("\n", 1)[1] in whole


def test_part_without_a_folder_is_of_the_usual_run(capsys, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(REFERENCE))
    assert bench(capsys, "show", "contact") == bench(capsys, "show", REFERENCE, "contact")


def test_few_perturbations_are_shown_level_by_level(tables):
    rows = tables["robustness"]
    (_, whole), (head, levels) = robustness.tables(rows[rows["axis"] == "half-turn-noise"])
    assert head == "half-turn-noise [rad], level by level (a/b: a of b starts go well)"
    assert list(levels) == ["law", "0", "0.001", "0.01", "0.03", "0.1", "0.3", "1"]
    assert list(levels["law"]) == list(whole["law"])[1:]  # the first line is theory's


def test_part_that_a_run_lacks_is_said_and_an_option_that_a_part_does_not_take_is_refused(capsys, finished):
    said = bench(capsys, "show", finished, "robustness")
    assert said.code == 0
    assert "nothing of robustness in this run" in said.out
    assert "contact takes no --outcomes" in refused(capsys, "show", finished, "contact", "--outcomes")


@pytest.mark.parametrize("words", [("arm",), ("results/reference", "arm")])
def test_unknown_part_is_refused_with_the_parts(capsys, words):
    line = refused(capsys, "show", *words)
    assert ", ".join(PARTS) in line
    assert "try: " in line


def test_names_stay_whole_where_the_table_is_wider_than_the_screen(capsys):
    episodes = Run(REFERENCE).table("episodes")
    for _, table in tables_of_arms(episodes[episodes["arm"] != ""]):
        Console(width=80, highlight=False, markup=False, emoji=False).print(frame_table(table))
    lines = capsys.readouterr().out.splitlines()
    assert max(len(line.rstrip()) for line in lines) <= 80
    assert any(re.match(r"linearized-euler-relative/zyx-euler +\d/\d ", line) for line in lines)
    assert any(line.rstrip() == "  @geometric+pseudo-inverse" for line in lines)


@pytest.mark.parametrize("width", [12, 40, 60])
def test_narrow_screen_shows_every_letter_of_a_table(capsys, width):
    cells = ["damped-least-squares-variable", "Chiaverini, Siciliano, Egeland 1994; Nakamura & Hanafusa 1986", "120.5"]
    table = pd.DataFrame([cells], columns=["name", "source", "median [s]"])
    Console(width=width, highlight=False, markup=False, emoji=False).print(frame_table(table))
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= width
    assert Counter("".join(cells).replace(" ", "")) <= Counter(said)


@pytest.mark.parametrize("gains", [Gains(100.0, 20.0), Gains(100.0, 13.0), Gains(25.0, 7.0)])
def test_nearest_situation_alone_is_decided_as_among_all(gains):
    wanted = NOMINAL._replace(zeta=gains.kv / (2.0 * gains.kp**0.5))
    at, verdict = decide_nearest(wanted)
    among_all = answer_nearest(wanted)
    assert (at, verdict) == (among_all.at, among_all.verdict)

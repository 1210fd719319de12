"""Files as CONTRIBUTING.md shows them do, in a copy of the repository, what it says of them.

A metric, an experiment, a perturbation, a claim and a table of a page are planted as they stand there, a law and an arm
as it says.
"""

import json
import math
import re
import shutil

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation as ScipyRotation
from support.recipes import TEXTS, copied, ran, said, shown, sources

import tasks
from bench.base.provenance import ROOT
from bench.findings.claims import all_claims
from bench.law.inputs import PAPERS_GAINS

PLANTED, LAWS = "tasks/conditions/rate_bias.py", "bench/law/contenders/regulators"
[PLANTED_AXIS] = shown("A perturbation", 1)
[PLANTED_METRIC] = shown("A metric", 1)
[PLANTED_PAGE_TABLE] = shown("A table of a page", 1)
PLANTED_EXPERIMENT, PLANTED_TABLE = shown("An experiment", 2)
FREE = f"C{len(all_claims()) + 1:02d}"
PLANTED_CLAIM, CARD = (text.replace("C48", FREE) for text in shown("A claim", 2))
REFERENCE = ROOT / "results" / "reference"

REFUSED_RUN = """
import sys

sys.stderr = sys.stdout
from bench.cli import main

sys.exit(main(["run", "--axis", "rate-bias", "--dry-run"]))
"""
REFUSED_CLAIMS = """
import sys

sys.stderr = sys.stdout
from bench.cli import main

sys.exit(main(["claims", sys.argv[1]]))
"""
REFUSED_LEVEL = """
import tasks
from tasks.condition import condition_at
from tasks.errors import BadValue

try:
    condition_at(tasks.axis("rate-bias"), 1.0)
except BadValue as error:
    print(error)
"""


def test_planted_axis_acts_and_is_in_the_thresholds_and_the_book_without_another_file_touched(
    tmp_path,
):
    (copied(tmp_path) / PLANTED).write_text(PLANTED_AXIS)
    *counted, mild, perturbed = ran(tmp_path, "-c", TEXTS["asked_of_axis"]).splitlines()
    assert counted == ["float64", "True ['rate-bias'] True"]
    # At rest the law's kp sin(angle) balances kv times the bias of 0.1 rad/s.
    angle = round(math.asin(PAPERS_GAINS.kv * 0.1 / PAPERS_GAINS.kp), 6)
    assert max(json.loads(mild)) < 1e-4
    assert json.loads(perturbed) == pytest.approx([angle] * 3, abs=1e-6)


def test_planted_axis_without_a_hook_is_refused_with_the_line_to_write(tmp_path):
    planted = PLANTED_AXIS.replace(", measured_rate=add_bias", "")
    (copied(tmp_path) / PLANTED).write_text(planted)
    refused = ran(tmp_path, "-c", REFUSED_RUN, code=2)
    assert f"{PLANTED}: the field 'rate_bias' has no hook, so it would perturb nothing" in refused
    assert "(try in the field: measured_rate=lambda level, omega, now: (omega[0] + level," in refused


def test_planted_axis_that_moves_the_goal_in_two_ways_is_refused(tmp_path):
    twice = 'sets=lambda level: {"rate_bias": level, "reference_amplitude": level},\n)'
    planted = PLANTED_AXIS.replace("measured_rate=add_bias", "goal=lambda *words: None")
    (copied(tmp_path) / PLANTED).write_text(planted.rstrip().removesuffix(")") + twice)
    refused = ran(tmp_path, "-c", REFUSED_LEVEL)
    assert "'rate-bias' sets rate_bias, reference_amplitude, of which more than one moves" in refused


def test_planted_claim_is_judged_by_its_criterion_from_rows_without_another_file_touched(tmp_path):
    before = sources(copied(tmp_path))
    room = tmp_path / "bench" / "findings" / "claims"
    (room / "planted_spread.py").write_text(PLANTED_CLAIM)
    (room / "planted_spread.toml").write_text(CARD)
    stored, alike, criterion = ran(tmp_path, "-c", TEXTS["asked_of_claim"], FREE, str(REFERENCE)).splitlines()
    rows = pq.read_table(REFERENCE / "episodes.parquet").to_pandas()
    rows = rows.query("task == 'free-body' and engine == 'ideal-rk4' and start_set == 'uniform'")
    times = rows.query("regulator == 'rotation-matrix' and representation == ''")["settling_time_s"]
    ratio = times.max() / times.min()
    assert ratio > 1.5
    assert stored == f"holds: The longest settling time is {ratio:.2f} times the shortest one."
    assert alike == "does not hold: The longest settling time is 1.00 times the shortest one."
    assert "at least 1.5 times the shortest one" in criterion
    for name in ("reference", "gains", "verdicts"):
        shutil.copytree(ROOT / "results" / name, tmp_path / "results" / name)
    [told] = said(tmp_path, ("claims", "results/reference"))
    assert re.search(rf"^{FREE} +Holds \({len(times):,} rows\): The settling time", told, re.MULTILINE)
    assert re.search(rf"There are no verdicts of other runs yet on [^.]*\b{FREE}\.", " ".join(told.split()))
    assert before.items() <= sources(tmp_path).items()


def test_planted_claim_with_the_id_of_another_one_is_refused(tmp_path):
    room = copied(tmp_path) / "bench" / "findings" / "claims"
    (room / "spread.py").write_text(PLANTED_CLAIM.replace(FREE, "C01"))
    (room / "spread.toml").write_text(CARD.replace(FREE, "C01"))
    refused = ran(tmp_path, "-c", REFUSED_CLAIMS, str(REFERENCE), code=2)
    assert "spread.py: another module has the claim C01, too (take the next free id)" in refused


def test_planted_law_settles_as_its_equation_does_and_is_said_not_to_be_in_the_map(tmp_path):
    before = sources(copied(tmp_path))
    (tmp_path / LAWS / "soft_chord.py").write_text(TEXTS["soft_chord"].lstrip("\n"))
    study = tmp_path / "results" / "situations"
    study.mkdir(parents=True)
    for name in ("situations.parquet", "provenance.json"):
        shutil.copy(ROOT / "results" / "situations" / name, study)
    unmapped, settled = ran(tmp_path, "-c", TEXTS["asked_of_law"]).splitlines()
    assert re.match(r"Not in the map yet: [^;]*\bsoft-chord\b[^;]*; --run simulates every law", unmapped)
    for angle, tick in json.loads(settled):
        motion = turn(angle, saturate, 5.0)
        # It settles when the angle stays within 2 % of the first one.
        settled_s = motion.t[np.abs(motion.y[0]) > 0.02 * angle][-1]
        # MuJoCo's steps of 1 ms against the continuous equation.
        assert 1e-3 * tick == pytest.approx(settled_s, rel=0.01)
    assert before.items() <= sources(tmp_path).items()


def test_planted_metric_is_the_time_that_the_equation_of_the_angle_says(tmp_path):
    before = sources(copied(tmp_path))
    (tmp_path / "bench/engines/metrics/motion/fast_time.py").write_text(PLANTED_METRIC)
    unit, *measured = ran(tmp_path, "-c", TEXTS["asked_of_metric"]).splitlines()
    assert (unit, len(measured)) == ("s", 3)
    for line in measured:
        angle, fast_time_s = json.loads(line)
        motion = turn(angle, math.sin, 1.5)
        is_fast = np.abs(motion.y[1]) > 1.0
        fast_time = np.trapezoid(is_fast.astype(float), motion.t)
        # A control period of 1 ms at each end.
        assert fast_time_s == pytest.approx(fast_time, abs=2e-3)
    assert before.items() <= sources(tmp_path).items()


def test_planted_experiment_writes_a_table_that_is_read_with_units_without_another_file_touched(
    tmp_path,
):
    before = sources(copied(tmp_path))
    room = tmp_path / "bench" / "experiments"
    (room / "start_angles.py").write_text(PLANTED_EXPERIMENT)
    (room / "start-angles.toml").write_text(PLANTED_TABLE)
    words = ("run", "--experiment", "start-angles", "--workers", "1", "--out", "results/mine")
    said(tmp_path, words)
    unit, *rows = ran(tmp_path, "-c", TEXTS["asked_of_experiment"]).splitlines()
    assert unit == "rad"
    measured = {name: (count, angle) for name, count, angle in map(json.loads, rows)}
    assert set(measured) == set(tasks.start_set_names())
    for name, (count, angle) in measured.items():
        starts = tasks.start_set(name)
        R = ScipyRotation.from_quat([start.quat_wxyz for start in starts], scalar_first=True)
        R_d = ScipyRotation.from_quat([start.goal_wxyz for start in starts], scalar_first=True)
        assert count == len(starts)
        # Near 180° SciPy's angle has lost half its digits.
        assert angle == pytest.approx((R_d.inv() * R).magnitude().max(), abs=1e-7)
    assert before.items() <= sources(tmp_path).items()


def test_planted_table_of_a_page_has_the_medians_of_the_rows_without_another_file_touched(tmp_path):
    before = sources(copied(tmp_path))
    (tmp_path / "report/figures/replication/paths.py").write_text(PLANTED_PAGE_TABLE)
    heads, _, *lines = ran(tmp_path, "-c", TEXTS["asked_of_page_table"], str(REFERENCE)).splitlines()
    assert heads == "| Regulator | Starts | Median path / shortest path |"
    rows = pq.read_table(REFERENCE / "episodes.parquet").to_pandas()
    rows = rows.query("task == 'free-body' and engine == 'ideal-rk4' and start_set == 'uniform' and converged != 'no'")
    assert len(lines) == 3
    for line in lines:
        law, starts, median = (cell.strip() for cell in line.strip("|").split("|"))
        regulator, _, representation = law.partition("/")
        is_own = (rows["regulator"] == regulator) & (rows["representation"] == representation)
        ratios = rows.loc[is_own, "path_ratio"]
        assert int(starts.replace("\u00a0", "")) == len(ratios)
        # The median as an element of the sample, rounded to the two places that are shown.
        assert float(median) == pytest.approx(np.quantile(ratios, 0.5, method="inverted_cdf"), abs=0.005 + 1e-9)
    assert before.items() <= sources(tmp_path).items()


def turn(angle, spring, length_s):
    """Return the motion theta'' = -kp spring(theta) - kv theta' from rest, by steps of at most 0.1 ms."""

    def rates(_, state):
        return state[1], -PAPERS_GAINS.kp * spring(state[0]) - PAPERS_GAINS.kv * state[1]

    return solve_ivp(rates, (0.0, length_s), (angle, 0.0), rtol=1e-9, atol=1e-12, max_step=1e-4)


def saturate(angle: float) -> float:
    """Return the spring of the planted law: its chord, of at most 1."""
    chord = 2.0 * math.sin(angle / 2.0)
    return chord / math.hypot(1.0, chord)


def test_planted_arm_has_its_own_reach_and_is_planned_without_another_file_touched(tmp_path):
    before = sources(copied(tmp_path))
    text = (ROOT / "tasks" / "arms" / "ur5e.xml").read_text(encoding="utf-8")
    changes = {
        'model="ur5e"': 'model="long-ur5e"',
        'data="Universal Robots UR5e"': 'data="UR5e with a longer forearm"',
        'name="wrist 1" pos="0 0 .3922"': 'name="wrist 1" pos="0 0 .4422"',
    }
    for old, new in changes.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    (tmp_path / "tasks" / "arms" / "long_ur5e.xml").write_text(text, encoding="utf-8")
    # Whatever the pose, a forearm that is longer by 5 cm moves the tool by 5 cm.
    assert json.loads(ran(tmp_path, "-c", TEXTS["asked_of_arm"])) == pytest.approx(0.05, abs=1e-12)
    [listed, planned] = said(tmp_path, ("list", "arms"), ("run", "--arm", "long-ur5e", "--dry-run"))
    assert re.search(r"^long-ur5e +6 +UR5e with a longer forearm", listed, re.MULTILINE)
    assert "long-ur5e" in planned
    assert before.items() <= sources(tmp_path).items()

"""Committed studies are whole and keep to theory, and are what the code makes now where some rows are made again."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.base.files import read_json
from bench.base.provenance import ROOT
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.experiments.robustness import HORIZON_S
from bench.experiments.tables import store
from bench.experiments.tables.run import Run, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.findings.maps import lost_share
from bench.findings.perturbed import by_level, studied
from bench.law.contenders.registry import find_contender
from bench.studies import gates, verdicts
from bench.studies.libraries.library import ANGLES, QUATERNION, Function, Library
from bench.studies.libraries.upstream import REPRODUCTIONS, check_patches
from bench.studies.libraries.verdict import of_quaternion
from bench.studies.robustness import STARTS
from bench.studies.verdicts import HALF_STEP, RUNS, SEEDS, STORED, plan_of, turned


def test_study_has_every_level_of_every_perturbation_for_every_law():
    found = studied().groupby("axis", observed=True)
    assert set(found.groups) == set(Run(RESULTS / "reference").table("robustness")["axis"])
    laws = set(studied()["contender"])
    assert {"late-braking", "rotation-matrix", "feedback-linearized/zyx-euler"} < laws
    for name, rows in found:
        levels = rows.groupby("contender", observed=True)["level"].agg(set)
        assert set(levels.index) == laws
        assert all(each == set(tasks.axis(name).levels) for each in levels)


def test_every_share_is_known_to_five_points():
    for good, starts in studied()[["good", "starts"]].drop_duplicates().itertuples(index=False):
        one = lost_share(int(good), int(starts))
        assert max(one.high - one.value, one.value - one.low) <= 0.0505
    assert set(studied()["starts"]) == {STARTS}


@pytest.mark.parametrize("law", ["rotation-matrix", "late-braking"])
def test_study_is_what_the_code_makes_now(law):
    unit = Unit("robustness", law, selector="saturation", count=STARTS, total=STARTS, horizon_s=HORIZON_S)
    now = with_contender(by_level(rows_of(Request("default"), unit)))
    kept = studied()[(studied()["axis"] == "saturation") & (studied()["contender"] == find_contender(law).name)]
    assert now["good"].tolist() == kept["good"].tolist()
    np.testing.assert_allclose(now["median_s"], kept["median_s"], atol=1e-3)


def test_median_counts_what_never_settles_and_the_longest_does_not():
    rows = pd.DataFrame({"outcome": ["settled", "settled", "timed-out"], "settling_time_s": [0.5, 0.7, np.nan]})
    rows = rows.assign(axis="delay", regulator="mine", level=0.01, tail_rms_rad=0.0)
    [one] = by_level(rows).to_dict("records")
    assert (one["starts"], one["good"], one["median_s"], one["longest_s"]) == (3, 2, 0.7, 0.7)
    assert by_level(rows.assign(outcome="timed-out"))["median_s"].tolist() == [np.inf]


def test_paths_count_from_where_the_judge_begins_and_not_near_the_goal():
    rows = pd.DataFrame({"judged_rad": [2.0, 1.0, 0.4], "path_ratio": [1.4, 1.6, 9.0]})
    rows = rows.assign(axis="goal-jump", regulator="mine", level=0.1, tail_rms_rad=0.0, outcome="settled")
    [one] = by_level(rows.assign(settling_time_s=0.5)).to_dict("records")
    assert (one["far"], one["long"], one["path_rad"]) == (2, 1, 2.8)


def test_same_code_raised_no_false_alarm():
    rows = read_json(gates.STORED)["rows"]
    assert len(rows) == gates.COMPARISONS
    assert not any(one["alarms"] for one in rows)


def test_no_verdict_hangs_on_the_draw_of_twenty_seeds_or_on_the_step():
    stored = read_json(STORED)
    assert len(SEEDS) == 20
    assert set(stored["runs"]) == set(RUNS)
    every = {one.id: str(one.word) for one in claims.judge_all(verdicts.REFERENCE)}
    assert list(every) == [one.id for one in claims.all_claims()]
    # A claim that is newer than the study is not in it, and `bench claims` says so.
    reference = {id: word for id, word in every.items() if id in stored["reference"]}
    assert len(reference) >= 47
    stale = set(stored.get("stale", []))  # their criteria are newer than the study, which says nothing of them
    assert set(turned(stored["runs"], reference)) <= stale
    assert stale < set(reference)
    assert stored["reference"] == reference


def test_word_that_turns_is_told_by_claim_and_run():
    runs = {"1": {"words": {"C01": "holds", "C02": "does not hold"}}, "2": {"words": {"C01": "holds"}}}
    found = turned(runs, {"C01": "holds", "C02": "holds"})
    assert found == {"C02": {"1": "does not hold", "2": "not judged"}}


def test_seed_and_step_run_what_hangs_on_them():
    drawn, halved = plan_of("3"), plan_of(HALF_STEP)
    assert (drawn.request.seed, drawn.request.dt_s) == (3, 1e-3)
    assert (halved.request.seed, halved.request.dt_s) == (0, 5e-4)
    kinds, stepped = ({unit.experiment for unit in plan.units} for plan in (drawn, halved))
    assert {"free-body", "arm", "jacobians", "probes", "traces", "robustness"} == kinds
    assert stepped == kinds - {"jacobians"} | {"boundaries", "contact"}


PATCHES = sorted((ROOT / "bench" / "studies" / "libraries" / "patches").glob("*.patch"))
LACKING = 77
"""Exit code of a patch's command where this machine lacks what the test needs."""


def copy_source(patch: dict[str, str], folder: Path) -> bool:
    """Copy a checkout in $ORIENTATION_BENCH_SOURCES, or the installed package, and return whether there is one."""
    checkout = Path(os.environ.get("ORIENTATION_BENCH_SOURCES", "no such folder")) / patch["Repository"].split("/")[1]
    package = Path(patch.get("Package", ""))
    spec = importlib.util.find_spec(package.name) if package.name else None
    if not checkout.is_dir() and (spec is None or spec.origin is None):
        return False
    given, place = (checkout, folder) if checkout.is_dir() else (Path(spec.origin).parent, folder / package)
    shutil.copytree(given, place, ignore=shutil.ignore_patterns(".git", "assets"), dirs_exist_ok=True)
    return True


@pytest.mark.parametrize("path", PATCHES, ids=lambda path: path.stem)
def test_patch_makes_its_failing_test_pass(path, tmp_path):
    patch = dict(re.findall(r"^(\w+): (.+)$", path.read_text(), re.MULTILINE))
    subprocess.run(["git", "apply", "--numstat", path], check=True)
    if not copy_source(patch, tmp_path):
        pytest.skip(f"no source: put a checkout of {patch['Repository']} into $ORIENTATION_BENCH_SOURCES")

    def run_with(part: str) -> int:
        subprocess.run(["git", "apply", part, path], cwd=tmp_path, check=True)
        environment = {"PYTHON": sys.executable, **os.environ}
        return subprocess.run(["sh", "-c", patch["Run"]], cwd=tmp_path, env=environment, check=False).returncode

    before = run_with("--include=*test*")
    if before == LACKING:
        pytest.skip(f"its test needs what is not installed here: {patch['Run']}")
    assert (before, run_with("--exclude=*test*")) == (1, 0)


@pytest.mark.parametrize("case", REPRODUCTIONS.values(), ids=list(REPRODUCTIONS))
@pytest.mark.parametrize(("share", "state"), [(1.0, "fixed"), (0.5, "not fixed")])
def test_reproduction_tells_right_functions_from_wrong_ones(case, share, state):
    right = Function(case.function, QUATERNION, lambda q: share * of_quaternion(q))
    [found] = check_patches(Library(case.library, "source@commit", (right,), is_restated=True)).values()
    assert (found["state"], found["version"]) == (state, "commit")


def test_verdicts_on_libraries_name_the_zero_at_180_wherever_the_stored_answers_have_it():
    answers = store.read(RESULTS / "libraries", "libraries")
    at_180 = answers[answers["turn_set"].eq("half-turn") & answers["form"].ne(ANGLES)]
    zeros = at_180[at_180["nought"] > 0]
    verdicts_of_libraries = store.read(RESULTS / "libraries", "verdicts")
    names_it = verdicts_of_libraries["faults"].astype(str).str.contains("dead-at-180")
    named = verdicts_of_libraries[names_it]
    answered = named.merge(answers[["library", "function"]].drop_duplicates())  # restated controllers were not asked
    assert {*zip(zeros["library"], zeros["function"], strict=True)} == {
        *zip(answered["library"], answered["function"], strict=True)
    }
    assert len(zeros) > 1

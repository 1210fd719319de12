"""The promise of growing: one file adds a regulator, representation, Jacobian, inverse, impedance, baseline,
metric, task, arm, start set, perturbation, experiment, claim, or page; a metric or task of contact too, and starts of
arms."""

import json
import math
import re
import shutil
import signal
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.integrate import solve_ivp
from support.command_line import digest, python

from bench.base.provenance import ROOT
from bench.experiments.tables import store
from bench.findings.claims import all_claims
from bench.law.contenders.registry import FOLDERS, contenders
from bench.law.inputs import PAPERS_GAINS
from bench.law.kinds import HasLaw


def renamed(room: str, of: str, kind: str) -> str:
    """The file of a contender that is another one by another name."""
    name = f'name="dropped-{kind}", title="Dropped {kind}"'
    constant = room.removesuffix("s").upper()
    head = f'"""By another name."""\n\nimport dataclasses\n\nfrom bench.law.contenders.{room} import {of}\n\n'
    record = f"{of}.{constant}"
    if issubclass(FOLDERS[room], HasLaw):
        return f"{head}{constant} = dataclasses.replace({record}, law={record}.law._replace({name}))\n"
    return f"{head}{constant} = {record}._replace({name})\n"


SUPPORT = ROOT / "tests" / "support"
HERE = SUPPORT / "dropped"
DROPPED = {
    "bench/law/contenders/representations/dropped_coordinates.py": renamed(
        "representations", "zyx_euler", "coordinates"
    ),
    "bench/law/contenders/jacobians/dropped_jacobian.py": renamed("jacobians", "geometric", "jacobian"),
    "bench/law/contenders/inverses/dropped_inverse.py": renamed("inverses", "solve", "inverse"),
    "bench/law/contenders/impedances/dropped_impedance.py": renamed("impedances", "geometric", "impedance"),
    "bench/law/contenders/shipped/dropped_shipped.toml": (
        ROOT / "bench" / "law" / "contenders" / "shipped" / "deoxys.toml"
    ).read_text(),
    "bench/law/contenders/springs/dropped_spring.py": renamed("springs", "vector_part", "spring"),
    "bench/law/contenders/compensators/dropped_compensator.py": renamed("compensators", "integral", "compensator"),
    "bench/law/contenders/baselines/dropped_baseline.py": renamed("baselines", "resolved_rate", "baseline"),
    **{str(path.relative_to(HERE)).removesuffix(".text"): path.read_text() for path in sorted(HERE.rglob("*.text"))},
}
"""Files that are dropped into a copy of the tree, one of each kind that grows by a file: path -> text."""
EXPERIMENT, PLANTED = "bench/experiments/dropped_experiment.py", "tasks/conditions/rate_bias.py"
LAWS = "bench/law/contenders/regulators"
TEXTS = {path.stem: path.read_text() for path in (SUPPORT / "planted_texts").glob("*.text")}
RECIPE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def shown(subject: str, count: int) -> list[str]:
    """Return the first blocks of code that CONTRIBUTING.md shows of a subject."""
    blocks = RECIPE.partition(f"**{subject}, for example.**")[2].split("```")[1::2]
    return [block.partition("\n")[2] for block in blocks[:count]]


[PLANTED_AXIS] = shown("A perturbation", 1)
FREE = f"C{len(all_claims()) + 1:02d}"
PLANTED_CLAIM, CARD = (text.replace("C48", FREE) for text in shown("A claim", 2))
REFERENCE = ROOT / "results" / "reference"

INDEX = "# A book of one page\n\nIt cites {cite}`murphy1988`.\n"

CONTENTS = "format: jb-book\nroot: index\nchapters:\n- glob: pages/*\n"

LISTED = {"dropped_touch", "dropped_column", "C99"}
LISTED |= {Path(name).stem.replace("_", "-") for name in DROPPED if name.startswith(("bench/law", "tasks"))}
"""Names that the list has: columns of metrics, a claim, and the files' own."""


def copied(tree: Path) -> Path:
    """A copy of the rooms."""
    for room in ("bench", "tasks", "report"):
        shutil.copytree(
            ROOT / room, tree / room, ignore=shutil.ignore_patterns("__pycache__", "_build", "pages", "index.md")
        )
    return tree


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the rooms with no laws but those that other files build on, for every run counts the operations of all;
    nothing but the files above is added to it; the book cut down to its references."""
    tree = copied(tmp_path_factory.mktemp("growing"))
    for name in contenders("regulators").keys() - {"rotation-matrix", "feedback-linearized", "rotation-vector"}:
        (tree / "bench" / "law" / "contenders" / "regulators" / f"{name.replace('-', '_')}.py").unlink()
    (tree / "report" / "pages").mkdir()
    for name in ("pyproject.toml", "CITATION.cff"):
        shutil.copy(ROOT / name, tree / name)
    (tree / "report" / "pages" / "99-references.md").write_text("# References\n\n```{bibliography}\n```\n")
    (tree / "report" / "index.md").write_text(INDEX)
    (tree / "report" / "_toc.yml").write_text(CONTENTS)  # a part without a page is refused
    return tree


COMMANDS = """
import json, sys
from bench.cli import main

for words in json.loads(sys.argv[1]):
    code = main(words)
    print(sys.argv[2], flush=True)
    if code:
        sys.exit(f"{words}: exit code {code}")
"""
END = "=" * 100

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


def said(tree: Path, *commands: tuple[str, ...]) -> list[str]:
    """What each command prints in that tree; all must succeed."""
    return ran(tree, "-c", COMMANDS, json.dumps(commands), END).split(END)[:-1]


def ran(tree: Path, *words: str, code: int = 0, **variables: str) -> str:
    """What Python prints there, with these variables of the environment."""
    caches = {"XDG_CACHE_HOME": str(tree / "cache"), "NUMBA_CACHE_DIR": None, "ORIENTATION_BENCH_RESULTS": None}
    return python(*words, cwd=tree, code=code, PYTHONPATH=str(tree), **caches, **variables)


def sources(tree: Path) -> dict[str, str]:
    """Every file that somebody wrote."""
    made = ("results", "cache", "report/_build")
    return {
        name: what for name, what in digest(tree).items() if not name.startswith(made) and "__pycache__" not in name
    }


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
    (room / "spread.py").write_text(PLANTED_CLAIM)
    (room / "spread.toml").write_text(CARD)
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
        # MuJoCo's steps of 1 ms against the continuous equation.
        assert 1e-3 * tick == pytest.approx(settle_softly(angle), rel=0.01)
    assert before.items() <= sources(tmp_path).items()


def settle_softly(angle: float) -> float:
    """Return the time [s] after which the planted law stays within 2 % of an angle, by its equation about one axis."""

    def rates(_, state):
        chord = 2.0 * math.sin(state[0] / 2.0)
        return state[1], -PAPERS_GAINS.kp * chord / math.hypot(1.0, chord) - PAPERS_GAINS.kv * state[1]

    found = solve_ivp(rates, (0.0, 5.0), (angle, 0.0), rtol=1e-9, atol=1e-12, max_step=1e-3)
    return found.t[np.abs(found.y[0]) > 0.02 * angle][-1]


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


@pytest.fixture(scope="module")
def before(tree):
    """Add the files; return the others."""
    found = sources(tree)
    for name, text in DROPPED.items():
        (tree / name).write_text(text.lstrip("\n"))
    return found


STARTED = ("--starts", "dropped-starts", "--horizon", "1")
RUN = ("run", "--task", "dropped-task", *STARTED, "--engine", "native", "--engine", "reference")


def test_dropped_files_are_listed_planned_and_counted_without_another_touched(tree, before):
    planned = (*RUN, "--regulator", "feedback-linearized", "--dry-run")
    listed, dry, counted = said(tree, ("list",), planned, ("count", "--regulator", "dropped-regulator"))
    for name in LISTED:
        assert f"\n{name} " in listed
    assert "feedback-linearized/dropped-coordinates" in dry  # a law for any coordinates has met the new ones
    assert "dropped-regulator  dropped-coordinates" in counted


@pytest.mark.weekly
@pytest.mark.book
def test_dropped_files_are_run_and_shown_without_another_touched(tree, before):
    on_arm = ("run", "--task", "dropped-arm-task", "--arm", "dropped-arm", "--starts", "dropped-turns")
    way = ("--regulator", "dropped-regulator@dropped-jacobian+dropped-inverse", "--out", "results/arm")
    touching = ("run", "--task", "dropped-probe", "--arm", "dropped-arm", "--out", "results/contact")
    controllers = ("--controller", "impedance-dropped-impedance", "--controller", "hybrid/dropped-coordinates+inverse")
    perturbed = ("run", "--axis", "dropped-axis", "--count", "2", "--out", "results/perturbation")
    told, *_, shown, compared = said(
        tree,
        (*RUN, "--regulator", "dropped-regulator"),
        (*on_arm, "--horizon", "1", "--engine", "reference", *way),
        (*touching, *controllers),
        (*perturbed, "--regulator", "dropped-regulator"),
        ("show", "results/latest", "--details"),
        ("compare", "results/latest", "results/latest"),
    )

    assert "4 episodes: dropped-regulator/dropped-coordinates by native and reference" in told

    assert "dropped-regulator" in shown
    assert "results/latest agrees with results/latest" in compared

    found = store.read(tree / "results" / "latest", "episodes")
    assert {name: set(found[name]) for name in ("regulator", "representation", "task", "start_set", "engine")} == {
        "regulator": {"dropped-regulator"},
        "representation": {"dropped-coordinates"},
        "task": {"dropped-task"},
        "start_set": {"dropped-starts"},
        "engine": {"native", "reference"},
    }
    assert (found["dropped_column"] == found["ticks"]).all()
    assert set(found["outcome"]) == {"settled"}

    turned = store.read(tree / "results" / "arm", "episodes")
    assert set(turned["arm"]) == {"dropped-arm"}
    assert set(turned["start_id"]) == {"turn"}
    assert (turned["dropped_column"] == turned["ticks"]).all()
    assert len(turned) == 1

    rows = store.read_arrow(tree / "results" / "contact" / "compliance.parquet", "compliance").to_pandas()
    assert list(rows["controller"]) == ["impedance-dropped-impedance", "hybrid", "hybrid"]
    assert list(rows["representation"]) == ["", "dropped-coordinates", "dropped-coordinates"]
    assert set(zip(rows["task"], rows["arm"], rows["outcome"], strict=True)) == {
        ("dropped-probe", "dropped-arm", "done")
    }
    assert list(rows["dropped_touch"]) == [300.0] * 3

    perturbed = store.read(tree / "results" / "perturbation", "robustness")
    assert list(perturbed["level"]) == [60.0, 60.0, 70.0, 70.0]
    assert (perturbed["dropped_column"] > 0).all()

    ran(tree, "report/build.py")
    page = (tree / "report" / "_build" / "html" / "pages" / "90-dropped-page.html").read_text()
    assert "rows with the dropped column: 4" in page
    assert r"Dropped family: dropped law, #009e73 x, f = \theta" in page
    assert "90-dropped-page.html" in (tree / "report" / "_build" / "html" / "index.html").read_text()

    after = sources(tree)
    assert {name: after[name] for name in before} == before
    assert after.keys() - before.keys() == DROPPED.keys()


def test_dropped_experiment_is_planned_run_resumed_stored_and_compared_without_another_file_touched(tree):
    before = sources(tree)
    (tree / EXPERIMENT).write_text(TEXTS["dropped_experiment"].lstrip("\n"))
    words = ("run", "--experiment", "dropped-experiment", "--workers", "1", "--out")
    ran(tree, "-m", "bench", *words, "results/killed", code=-signal.SIGKILL, KILLED_AT="rotation-vector")
    listed, planned, resumed, whole, compared = said(
        tree,
        ("list", "experiments"),
        (*words, "results/none", "--dry-run"),
        (*words, "results/killed"),
        (*words, "results/whole"),
        ("compare", "results/killed", "results/whole"),
    )
    found = [pq.read_table(tree / "results" / name / "dropped.parquet") for name in ("killed", "whole")]
    count = found[1].num_rows
    assert "\ndropped-experiment  dropped " in listed
    assert f"{count} units" in planned
    assert f"going on: {count - 1} of {count} units are done" in resumed
    assert "going on" not in whole
    assert found[0].equals(found[1])
    assert found[1].schema.field("kp").metadata[b"unit"] == b"1/s^2"
    assert "agrees with" in compared
    after = sources(tree)
    assert {name: after[name] for name in before} == before
    assert after.keys() - before.keys() <= {EXPERIMENT}

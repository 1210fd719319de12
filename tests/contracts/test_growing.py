"""The promise of growing: one file adds a regulator, representation, Jacobian, inverse, impedance, metric, task, arm,
start set of the free body or of arms, perturbation, experiment, claim, or page; a metric or task of contact too."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from support.command_line import digest

from bench.contenders.registry import known_regulators
from bench.provenance import ROOT
from bench.tables import store

INDEX = "# A book of one page\n\nIt cites {cite}`murphy1988`.\n"

CONTENTS = "format: jb-book\nroot: index\nchapters:\n- glob: pages/*\n"


def renamed(room: str, of: str, kind: str) -> str:
    """The file of a contender that is another one by another name."""
    name = f'name="dropped-{kind}", title="Dropped {kind}"'
    constant = room.removesuffix("s").upper()
    head = f'"""By another name."""\n\nfrom bench.contenders.{room} import {of}\n\n'
    return f"{head}{constant} = {of}.{constant}._replace({name})\n"


DROPPED = {
    "bench/contenders/representations/dropped_coordinates.py": renamed("representations", "zyx_euler", "coordinates"),
    "bench/contenders/jacobians/dropped_jacobian.py": renamed("jacobians", "geometric", "jacobian"),
    "bench/contenders/inverses/dropped_inverse.py": renamed("inverses", "solve", "inverse"),
    "bench/contenders/impedances/dropped_impedance.py": renamed("impedances", "geometric", "impedance"),
    "bench/contenders/regulators/dropped_regulator.py": '''
"""Damping, and a spring on the first coordinate."""

from bench.law import ANGLE, Look, Regulator, kernel


def law_in(representation):
    """The law in the coordinates of one representation."""
    chart = representation.chart

    @kernel
    def law(R, omega, goal, gains):
        """u = -Kv omega - Kp alpha e_z."""
        E = chart(R).E
        return (-gains.kv * omega[0], -gains.kv * omega[1], -gains.kp * E[0] - gains.kv * omega[2])

    return law


REGULATOR = Regulator(
    name="dropped-regulator",
    title="Dropped regulator",
    source="none",
    formula="u",
    law_in=law_in,
    coordinates=("dropped-coordinates",),
    property="none",
    short="dropped law",
    look=Look("green", "x", "dotted"),
    family="Dropped family",
    equation=ANGLE,
)
''',
    "bench/metrics/motion/dropped_metric.py": '''
"""Ticks with a command: all of them."""

from bench.law import kernel
from bench.metrics.metric import Metric


@kernel
def update(value, sample):
    """One more."""
    return value + 1.0


def finish(value, ending):
    """As it is."""
    return value


METRIC = Metric("dropped_column", "1", "ticks with a command", 0.0, update, finish)
''',
    "bench/metrics/contact/dropped_touch.py": '''
"""Ticks recorded: all of them."""

from bench.metrics.contact_metric import ContactMetric


def measure(pose):
    """Of all trials of the pose."""
    return float(sum(len(one.time) for one in pose.responses))


METRIC = ContactMetric("dropped_touch", "1", "ticks recorded", measure)
''',
    "tasks/domains/dropped_probe.py": '''
"""Known moments by another name, at two frames of the hand."""

from tasks.domains import wrench_probe


def trials(arm, dense=False):
    """Of the first two poses."""
    return wrench_probe.trials(arm)[:12]


TASK = wrench_probe.TASK._replace(name="dropped-probe", title="Dropped probe", horizon_s=0.05, trials=trials)
''',
    "tasks/arms/dropped_arm.py": '''
"""The UR5e by another title."""

from tasks.arm import arm


def xml() -> str:
    """Its MJCF text, otherwise as it is."""
    return arm("ur5e").xml.replace("Universal Robots UR5e", "Dropped arm")
''',
    "tasks/arm_starts/dropped_turns.py": '''
"""A small turn of the tool about the base z axis, from the arm's home."""

import math

from tasks.base import ArmStartSet, Start
from tasks.kinematics import Kinematics
from tasks.rotations import multiply


def build(arm, count, seed):
    """0.2 rad."""
    _, quat = Kinematics(arm).pose(arm.home)
    goal = multiply((math.cos(0.1), 0.0, 0.0, math.sin(0.1)), quat)
    return [Start("turn", quat, goal_wxyz=goal, q=arm.home, qdot=(0.0,) * arm.joints)]


STARTS = ArmStartSet("dropped-turns", "A small turn", 1, build)
''',
    "tasks/domains/dropped_arm_task.py": '''
"""Holding and turning by another name, from one start set."""

from tasks.domains import arm_regulation


def on(arm):
    """The task on one arm."""
    return arm_regulation.on(arm)._replace(name="dropped-arm-task", start_sets=("dropped-turns",))


TASK = arm_regulation.TASK._replace(
    name="dropped-arm-task", title="Dropped arm task", on=on, start_sets=("dropped-turns",)
)
''',
    "tasks/domains/dropped_task.py": '''
"""The free body by another name."""

from tasks.domains import free_body

TASK = free_body.TASK._replace(name="dropped-task", title="Dropped task", start_sets=("dropped-starts",))
''',
    "tasks/starts/dropped_starts.py": '''
"""Two starts about z."""

from tasks.base import Start, StartSet


def build(count, seed):
    """0.2 rad and a right angle, to rounding."""
    small, right = (0.9950041652780258, 0.0, 0.0, 0.09983341664682815), (0.5**0.5, 0.0, 0.0, 0.5**0.5)
    return [Start("small", small), Start("right", right)]


STARTS = StartSet("dropped-starts", "Two starts about z", 2, build)
''',
    "tasks/conditions/dropped_axis.py": '''
"""A bound on the command."""

from tasks.condition import Axis, Condition

AXIS = Axis("dropped-axis", "A dropped axis", "rad/s^2", (60.0, 70.0), None, lambda level: Condition(bound=level))
''',
    "bench/findings/claims/dropped_claim.py": '''
"""A claim about nothing."""

from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Word, claim


@claim(id="C99", section="9", sentence="A dropped claim.", question="None?", criterion="It holds.")
def c99(results):
    """One row."""
    return Word.HOLDS, evidence("1 row.", 1, ("experiment",))
''',
    "report/pages/90-dropped-page.md": """---
jupytext: {text_representation: {extension: .md, format_name: myst}}
kernelspec: {name: python3, display_name: Python 3}
---
# The dropped page

```{code-cell} python
from bench.tables import read
print("rows with the dropped column:", read.episodes(task="dropped-task")["dropped_column"].count())
```

```{code-cell} python
from bench.findings.theory.isotropic import EQUATIONS
from report.figures.kit import families, style
from report.figures.kit.inline import picture

@picture
def drawn():
    figure, axes = style.panels()
    [family] = families.present(read.episodes()["contender"].unique())
    for name, word in family.laws.items():
        look = style.look(name)
        axes.plot([0, 1], color=look.colour, marker=look.marker, linestyle=look.line, label=word)
    return figure, f"{family.title}: {word}, {look.colour} {look.marker}, f = {EQUATIONS[name].formula}"

drawn()
```
""",
}

EXPERIMENT = "bench/experiments/dropped_experiment.py"
DROPPED_EXPERIMENT = '''
"""Position gains: a unit a law; killed at the one that the environment names."""

import os
import signal

import pandas as pd

from bench.experiments.experiment import Experiment, Unit
from bench.tables.column import Table, numbers, words


def columns():
    """dropped.parquet: a row a law."""
    return [*words(law="the law"), *numbers("1/s^2", "position gain", "kp")]


def units(asked):
    """A unit a law."""
    return tuple(Unit("dropped-experiment", one.name, episodes=1) for one in asked.laws)


def rows(settings, unit):
    """One."""
    if os.environ.get("KILLED_AT") == unit.contender:
        os.kill(os.getpid(), signal.SIGKILL)
    return pd.DataFrame({"law": [unit.contender], "kp": [settings.gains.kp]})


EXPERIMENT = Experiment(
    "dropped-experiment",
    "A dropped experiment",
    Table("dropped", columns, ("law",)),
    units,
    rows,
    cost_s=lambda unit: 0.1,
    compiles=False,
    summary=lambda frame: frame,
)
'''

LISTED = {
    "regulators": "dropped-regulator",
    "representations": "dropped-coordinates",
    "metrics": "dropped_column",
    "tasks": "dropped-task",
    "tasks of arms": "dropped-arm-task",
    "starts": "dropped-starts",
    "starts of arms": "dropped-turns",
    "jacobians": "dropped-jacobian",
    "inverses": "dropped-inverse",
    "impedances": "dropped-impedance",
    "metrics of contact": "dropped_touch",
    "tasks in contact": "dropped-probe",
    "arms": "dropped-arm",
    "axes": "dropped-axis",
    "claims": "C99",
}


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the rooms with no laws but those that other files build on, for every run counts the operations of all;
    nothing but the files above is added to it; the book cut down to its references."""
    tree = tmp_path_factory.mktemp("growing")
    ignored = shutil.ignore_patterns("__pycache__", "_build", "pages", "index.md")
    for room in ("bench", "tasks", "report"):
        shutil.copytree(ROOT / room, tree / room, ignore=ignored)
    for name in known_regulators().keys() - {"rotation-matrix", "feedback-linearized"}:
        (tree / "bench" / "contenders" / "regulators" / f"{name.replace('-', '_')}.py").unlink()
    (tree / "report" / "pages").mkdir()
    for name in ("pyproject.toml", "CITATION.cff", "report/pages/99-references.md"):
        shutil.copy(ROOT / name, tree / name)
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


def said(tree: Path, *commands: tuple[str, ...]) -> list[str]:
    """What each command prints in that tree; all must succeed."""
    return ran(tree, "-c", COMMANDS, json.dumps(commands), END).split(END)[:-1]


def ran(tree: Path, *words: str, code: int = 0, **variables: str) -> str:
    """What Python prints there, with these variables of the environment."""
    ours = {
        **os.environ,
        **variables,
        "PYTHONPATH": str(tree),
        "XDG_CACHE_HOME": str(tree / "cache"),
    }
    ours.pop("NUMBA_CACHE_DIR", None)
    ours.pop("ORIENTATION_BENCH_RESULTS", None)
    done = subprocess.run([sys.executable, *words], cwd=tree, env=ours, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


def sources(tree: Path) -> dict[str, str]:
    """Every file that somebody wrote."""
    made = ("results", "cache", "report/_build")
    return {
        name: what for name, what in digest(tree).items() if not name.startswith(made) and "__pycache__" not in name
    }


@pytest.mark.slow
@pytest.mark.book
def test_dropped_files_are_listed_run_counted_and_shown_without_another_touched(tree):
    before = sources(tree)
    for name, text in DROPPED.items():
        (tree / name).write_text(text.lstrip("\n"))

    engines = ("--engine", "native", "--engine", "reference")
    words = ("run", "--task", "dropped-task", "--starts", "dropped-starts", "--horizon", "1", *engines)
    on_arm = ("run", "--task", "dropped-arm-task", "--arm", "dropped-arm", "--starts", "dropped-turns")
    way = ("--regulator", "dropped-regulator@dropped-jacobian+dropped-inverse", "--out", "results/arm")
    touching = ("run", "--task", "dropped-probe", "--arm", "dropped-arm", "--out", "results/contact")
    controllers = ("--controller", "impedance-dropped-impedance", "--controller", "hybrid/dropped-coordinates+inverse")
    perturbed = ("run", "--axis", "dropped-axis", "--count", "2", "--out", "results/perturbation")
    listed, dry, counted, told, *_, shown, compared = said(
        tree,
        ("list",),
        (*words, "--regulator", "feedback-linearized", "--dry-run"),
        ("count", "--regulator", "dropped-regulator"),
        (*words, "--regulator", "dropped-regulator"),
        (*on_arm, "--horizon", "1", "--engine", "reference", *way),
        (*touching, *controllers),
        (*perturbed, "--regulator", "dropped-regulator"),
        ("show", "results/latest", "--details"),
        ("compare", "results/latest", "results/latest"),
    )

    for name in LISTED.values():
        assert f"\n{name} " in listed
    assert "feedback-linearized/dropped-coordinates" in dry  # a law for any coordinates has met the new ones
    assert "dropped-regulator  dropped-coordinates" in counted
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


@pytest.mark.slow
def test_dropped_experiment_is_planned_run_resumed_stored_shown_and_compared_without_another_file_touched(tree):
    before = sources(tree)
    (tree / EXPERIMENT).write_text(DROPPED_EXPERIMENT.lstrip("\n"))
    words = ("run", "--experiment", "dropped-experiment", "--workers", "1", "--out")
    ran(tree, "-m", "bench", *words, "results/killed", code=-signal.SIGKILL, KILLED_AT="rotation-matrix")
    listed, planned, resumed, whole, shown, compared = said(
        tree,
        ("list", "experiments"),
        (*words, "results/none", "--dry-run"),
        (*words, "results/killed"),
        (*words, "results/whole"),
        ("show", "results/killed", "--details"),
        ("compare", "results/killed", "results/whole"),
    )
    found = [pq.read_table(tree / "results" / name / "dropped.parquet") for name in ("killed", "whole")]
    count = found[1].num_rows
    assert "\ndropped-experiment  dropped.parquet" in listed
    assert f"in {count} units" in planned
    assert f"going on: {count - 1} of {count} units are done" in resumed
    assert "going on" not in whole
    assert found[0].equals(found[1])
    assert found[1].schema.field("kp").metadata[b"unit"] == b"1/s^2"
    assert "A dropped experiment" in shown
    assert "rotation-matrix" in shown
    assert "agrees with" in compared
    after = sources(tree)
    assert {name: after[name] for name in before} == before
    assert after.keys() - before.keys() <= {EXPERIMENT}

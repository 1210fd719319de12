"""The promise of growing: one file adds a regulator, representation, Jacobian, inverse, impedance, baseline,
metric, task, arm, start set, perturbation, experiment, claim, or page; a metric or task of contact too, and starts of
arms."""

import shutil
import signal
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from support.recipes import SUPPORT, TEXTS, copied, ran, said, sources

from bench.base.provenance import ROOT
from bench.experiments.tables import store
from bench.law.contenders.registry import FOLDERS, contenders
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
EXPERIMENT = "bench/experiments/dropped_experiment.py"


INDEX = "# A book of one page\n\nIt cites {cite}`murphy1988`.\n"

CONTENTS = "format: jb-book\nroot: index\nchapters:\n- glob: pages/*\n"

LISTED = {"dropped_touch", "dropped_column", "C99"}
LISTED |= {Path(name).stem.replace("_", "-") for name in DROPPED if name.startswith(("bench/law", "tasks"))}
"""Names that the list has: columns of metrics, a claim, and the files' own."""


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

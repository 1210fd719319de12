"""A law of the user's own, from one file: run on every engine, counted; what it raises or spoils becomes rows."""

import re

import numpy as np
import pytest
from support.bits import different_rows
from support.command_line import bench
from support.driving import METRICS, settings, spread
from support.user_law import spring_text

from bench.base.provenance import ROOT
from bench.engines.episode import FAILURE_TICK, OUTCOME
from bench.engines.simulate import run
from bench.experiments.suites import ENGINES
from bench.experiments.tables import store
from bench.experiments.tables.run import VARIABLE, shown_run
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import contenders_of
from report.figures.cards import regulators
from report.figures.cards.card import fold
from tasks.base import Start
from tasks.verdict import CRASHED, SINGULAR

README = (ROOT / "README.md").read_text()
EXAMPLE = next(code for code in re.findall(r"```python\n(.*?)```", README, re.DOTALL) if "REGULATOR" in code)
ON_BODY = ("--regulator", "gibbs", "--task", "free-body")


def contender(folder, *body: str, remembers: bool = False):
    """The rotation-matrix law to the identity, with `body` before its return."""
    text = spring_text(*body)
    if remembers:
        text = text.replace("gains):", "gains, memory):").replace("return (-x, -y, -z)", "return (-x, -y, -z), memory")
        text = text.replace("law)\n", "law, memory=(0.0, 1.0, 2.0, 3.0))\n")
    path = folder / "own.py"
    path.write_text(text)
    [one] = contenders_of(load_law(path))
    return one


STARTS = [
    Start("near", (np.cos(0.1), np.sin(0.1), 0.0, 0.0)),
    Start("far", (np.cos(1.2), 0.0, np.sin(1.2), 0.0)),
    Start("spinning", (np.cos(0.3), 0.0, 0.0, np.sin(0.3)), (5.0, -7.0, 11.0)),
]
"""0.2 rad about x, 2.4 rad about y, and one that spins at 14 rad/s."""


def rows(engine, one, starts=STARTS, horizon_s=0.2):
    """What an engine gives back."""
    return run(engine, one, "free-body", starts, settings(horizon_s=horizon_s), METRICS)


@pytest.fixture(scope="module", params=[False, True], ids=["plain", "with memory"])
def fails_far_away(request, tmp_path_factory):
    """A law that fails in a different way in each of five regions, and near the goal in none."""
    return contender(
        tmp_path_factory.mktemp("law"),
        "if R.n[0] < -0.5: raise ValueError('no')",
        "if R.n[0] < 0.0: x = math.nan",
        "if R.n[0] < 0.5: raise KeyError(1)",
        "if omega[2] > 9.0: y = math.inf",
        "if omega[2] < -9.0: z = 1.0 / (R.o[0] - R.o[0])",
        remembers=request.param,
    )


@pytest.mark.parametrize("engine", ENGINES)
def test_law_that_raises_has_crashed_and_one_that_is_not_finite_is_singular(fails_far_away, engine):
    given = rows(engine, fails_far_away)
    assert given[0, OUTCOME] not in (CRASHED, SINGULAR)
    assert given[1:, OUTCOME].tolist() == [CRASHED, SINGULAR]
    assert given[1:, FAILURE_TICK].tolist() == [0.0, 0.0]


def test_law_that_raises_gives_the_reference_rows_natively_bit_for_bit(fails_far_away):
    starts = [*STARTS, *spread(3)]
    reference, native = (rows(engine, fails_far_away, starts, horizon_s=0.1) for engine in ("reference", "native"))
    assert 0 < sum(reference[:, OUTCOME] == CRASHED) < len(starts)
    assert different_rows(native, reference) == []


def test_law_that_divides_by_a_constant_of_the_run_is_the_same_natively(tmp_path):
    """Gains and goal are numpy.float64 in the dm_control loop too, where a Python float would raise."""
    one = contender(tmp_path, "x = x + 1.0 / (1.0 / goal.R.o[0]) + 1.0 / (1.0 / (gains.kp - 100.0))")
    reference, native = (rows(engine, one) for engine in ("reference", "native"))
    assert not {CRASHED, SINGULAR} & set(reference[:, OUTCOME])
    assert different_rows(native, reference) == []


@pytest.mark.parametrize(
    ("words", "has", "lacks"),
    [
        (("list", "regulators"), r"^my-law .*my_law\.py", "^$"),
        (("count", "--stages"), r"^my-law .* regulate ", "rotation-matrix"),
        (("run", "--suite", "quick", "--dry-run"), r"^laws: [^:]*rotation-matrix[^:]*my-law$", "^$"),
    ],
)
def test_own_law_is_listed_with_its_file_counted_alone_and_run_beside_ours(tmp_path, capsys, words, has, lacks):
    (tmp_path / "my_law.py").write_text(EXAMPLE)
    said = bench(capsys, *words, "--law", tmp_path / "my_law.py")
    assert said.code == 0
    assert re.search(has, said.out, re.MULTILINE)
    assert not re.search(lacks, said.out)


def test_own_law_runs_on_every_engine_and_settles_and_the_run_keeps_it_for_the_report(tmp_path, monkeypatch, capsys):
    path, out = tmp_path / "my_law.py", tmp_path / "run"
    path.write_text(EXAMPLE)
    engines = [word for engine in ENGINES for word in ("--engine", engine)]
    words = ("--regulator", "my-law", "--starts", "paper", "--horizon", "1.5", *engines, "--out", out)
    assert bench(capsys, "run", "--law", path, *words).code == 0
    found = store.read(out, "episodes")
    assert sorted(found["engine"].unique()) == sorted(ENGINES)
    assert set(found["outcome"]) == {"settled"}
    assert set(found["regulator"]) == {"my-law"}
    assert "my-law" in set(store.read(out, "costs")["regulator"])
    assert (out / "laws" / "my_law.py").read_text() == EXAMPLE
    path.unlink()
    monkeypatch.setenv(VARIABLE, str(out))
    [own] = shown_run().user_laws()
    assert own.name == "my-law"
    assert regulators.in_order()[-1].name == "my-law"
    text = fold(regulators.source(own))
    assert "laws/my_law.py" in text
    assert "REGULATOR" in text


def test_law_file_that_lies_in_its_place_is_taken(capsys):
    path = ROOT / "bench" / "law" / "contenders" / "regulators" / "gibbs.py"
    judged, planned = bench(capsys, "judge", path), bench(capsys, "run", "--law", path, *ON_BODY, "--dry-run")
    assert (judged.code, planned.code) == (0, 0)
    assert judged.out.startswith("gibbs: no fault found.")
    assert "laws: gibbs\n" in planned.out

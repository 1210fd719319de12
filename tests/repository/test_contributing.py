"""The way of an episode that CONTRIBUTING.md shows has functions that exist, and calls the law as it says."""

import ast
import re
import traceback

import numpy as np
from support.recipes import RECIPE

from bench.base.provenance import ROOT
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.tables.store import table_of_unit
from bench.law.contenders.registry import contenders, find_contender

SECTION = RECIPE.partition("\n## From a law to a number of the book\n")[2].partition("\n## ")[0]
ROW = re.compile(r"^\| \**`([\w/]+\.py)`\** \| (.*?) \| .*\|$", re.MULTILINE)
WAY = ROW.findall(SECTION)
"""A file, and its functions between backticks."""


def test_every_file_on_the_way_has_its_functions():
    assert len(WAY) > 10
    for path, functions in WAY:
        tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
        names = {getattr(node, "name", "") for node in ast.walk(tree)}
        assert {"", *re.findall(r"`(\w+)`", functions)} <= names, path


def test_law_is_called_through_the_files_of_the_way_in_their_order(monkeypatch):
    contender, files = find_contender("rotation-matrix"), []

    def law(R, omega, goal, gains):
        files.extend(frame.filename for frame in traceback.extract_stack())
        return contender.regulator.law(R, omega, goal, gains)

    changed = contender.regulator._replace(law=law)
    monkeypatch.setitem(contenders("regulators"), "rotation-matrix", changed)
    episode = {"task": "free-body", "engine": "reference", "selector": "uniform", "horizon_s": 0.001}
    unit = Unit("free-body", "rotation-matrix", count=1, total=1, **episode)
    rows = table_of_unit(Request(), unit)
    assert np.isfinite(rows["final_angle_rad"].to_numpy()).all()
    paths = [path for path, _ in WAY]
    first, last = (paths.index(f"bench/{name}.py") for name in ("experiments/tables/store", "engines/binding"))
    waiting = dict.fromkeys(name.removeprefix(f"{ROOT}/") for name in files)
    assert [path for path in waiting if path in paths] == paths[first : last + 1]

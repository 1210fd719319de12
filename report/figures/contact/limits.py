"""Tasks in contact with motors that are cut and a force sensor as sold; read from results/contact."""

from __future__ import annotations

import functools
from collections.abc import Iterator

import pandas as pd

from bench.experiments.tables.read import with_contender
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from report.figures.contact.in_contact import MEASURES, SPRINGS
from report.figures.contact.rows import PAPERS, PAPERS_EULER
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

SETTINGS = {"ideal": "Ideal motors", "motors": "Motors cut", "sensor": "Motors cut, sensor of 100 Hz"}
NAMES = {PAPERS: "Cartesian", PAPERS_EULER: "Euler, all β", SPRINGS: "springs"}
LIMITS = Table(
    f"Task | Measured at the end | Control | Episodes | {' | '.join(SETTINGS.values())}", words=SETTINGS.values()
)


@functools.cache
def rows() -> pd.DataFrame:
    """Return a row a pose, setting and controller."""
    found = with_contender(read(RESULTS / "contact", "contact_limits"))
    return found.assign(contender=found["contender"].astype(str), task=found["task"].astype(str))


def compare_settings() -> Iterator[tuple]:
    """Return a row a task and controller, with what is measured in each setting."""
    for task, measure in MEASURES.items():
        for controller, name in NAMES.items():
            own = rows()[(rows()["task"] == task) & (rows()["contender"] == controller)]
            by_setting = [own[own["setting"] == setting] for setting in SETTINGS]
            yield task.replace("-", " "), measure.title, name, len(by_setting[0]), *map(measure.of, by_setting)


def tables(_: Run) -> dict:
    """Return the settings beside each other."""
    return {"settings": LIMITS(compare_settings())}

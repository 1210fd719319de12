"""Tasks in contact with motors that are cut and a force sensor as sold; read from results/contact."""

from collections.abc import Iterator

from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from report.figures.contact.in_contact import MEASURES, PAPERS, PAPERS_EULER, SPRINGS
from report.figures.kit import html

SETTINGS = {
    "ideal": "Result with unlimited torque",
    "motors": "Result with limited torque",
    "sensor": "Result with limited torque and a noisy sensor",
}
NAMES = {PAPERS: "Cartesian", PAPERS_EULER: "Euler", SPRINGS: "springs"}
TITLES = {"crank": "angle by which the crank turned [deg]"}
"""What this table calls a measure, if not by its title."""
LIMITS = html.PageTable(
    f"Task | Measured quantity | Compliance | Episodes | {':.2g | '.join(SETTINGS.values())}:.2g"
)


def compare_settings() -> Iterator[tuple]:
    """Return a row a task and controller, with what is measured in each setting."""
    rows = Run(RESULTS / "contact").table("contact_limits")
    for task, measure in MEASURES.items():
        title = TITLES.get(task, measure.title)
        for controller, name in NAMES.items():
            own = rows[(rows["task"] == task) & (rows["contender"] == controller)]
            by_setting = [own[own["setting"] == setting] for setting in SETTINGS]
            yield task.replace("-", " "), title, name, len(by_setting[0]), *map(measure.compute, by_setting)


def facts(_: Run) -> dict:
    """Return by how much real motors and sensors change a number at most."""
    changes = [abs(one / ideal - 1.0) for *_, ideal, cut, sensor in compare_settings() for one in (cut, sensor)]
    return {"change": f"{100.0 * max(changes):.0f}"}

"""The appendix on other libraries: how functions were tested, and questions of users."""

from bench.experiments.tables.run import Run
from bench.findings.questions import QUESTIONS, FieldQuestion
from report.figures.kit import html
from report.figures.kit.spelling import power
from report.figures.libraries.as_shipped import reported
from report.figures.libraries.libraries import COUNT_RAD, SINGLE_RAD, lines, passed, table

PASSED = html.PageTable("Library | Functions")
ASKED = html.PageTable(
    "Question | Cause | Fix | Measured quantity | Value without the fix:.3g | Value with the fix:.3g"
)


def facts(_: Run) -> dict:
    """Return at which rotations the functions were tested, what is no fault, what passed, and questions of users."""
    rows = table()
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    return {
        "count": power(COUNT_RAD),
        "single_count": power(SINGLE_RAD),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "passed": PASSED(passed(lines())),
        "asked": ASKED(map(describe_question, QUESTIONS)),
    }


def describe_question(one: FieldQuestion) -> tuple:
    """Return a question's row; what is no more than rounding is 0."""
    links = ", ".join(reported(thread, f"`{thread.partition('/')[2]}`") for thread in one.threads)
    measured = (value if abs(value) > 1e-12 else 0.0 for value in one.measure())
    return f"{one.title} ({links})", one.cause, one.cure, f"{one.quantity} (right: {one.right:g})", *measured

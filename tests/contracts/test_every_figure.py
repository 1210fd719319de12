"""What figures of the published run hold: points and bends; `test_every_page` draws them all."""

from bench.experiments.tables.schema import RESULTS
from report.figures.kit.page import run_in
from report.figures.kit.rows import FEEDBACK
from report.figures.responses import responses

RUN = run_in(RESULTS / "reference")


def test_response_bends_are_nothing_under_feedback_linearization():
    traces, _ = responses.drawn(RUN)
    own = responses.find(traces, {"start_id": "figure-2.5", "contender": FEEDBACK})
    assert responses.bend_deg(own, 100.0, 20.0).max() < 1e-6

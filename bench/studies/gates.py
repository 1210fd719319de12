"""Time this checkout against itself, many times: every verdict but "same" is a false alarm of the gate.

A call that was stopped goes on with the comparisons that are missing, if the sources are the same. The rows are in
results/regress. Planted faults are in tests/regression.
"""

from typing import Any

from bench.base.files import write_json
from bench.base.provenance import ROOT
from bench.experiments.tables.schema import RESULTS
from bench.regression.revisions.times import SAME, compare_times
from bench.regression.timer import Side
from bench.studies.study import describe_study, make_parser, make_parts

STORED = RESULTS / "regress" / "same_code.json"
COMPARISONS = 20
"""Timings at the gate's own settings, some 50 CPU seconds each."""


def compare_same_code() -> dict[str, Any]:
    """Time this checkout against itself and return a row: least p, extreme ratios, what one run doubted, and alarms."""
    _, times = compare_times(Side(ROOT), Side(ROOT))
    ratios = [one.ratio for one in times.values()]
    return {
        **{"benchmarks": len(times), "least_p": min(one.p for one in times.values())},
        **{"least_ratio": round(min(ratios), 4), "largest_ratio": round(max(ratios), 4)},
        "doubted": [name for name, one in times.items() if one.confirmed is not None],
        "alarms": [name for name, one in times.items() if one.verdict != SAME],
    }


def main() -> None:
    """Run the study's command."""
    make_parser("gates", __doc__).parse_args()
    made = make_parts(STORED, {f"same-code {k}": compare_same_code for k in range(COMPARISONS)})
    write_json(STORED, {"about": describe_study("gates"), "rows": [*made.values()]})


if __name__ == "__main__":
    main()

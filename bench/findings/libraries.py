"""Say where answers of other libraries are, and from what sizes on an answer counts as wrong."""

from bench.experiments.tables.schema import RESULTS

STUDY = RESULTS / "libraries"
"""What `python -P -m bench.studies.libraries` and `bench.studies.restated` keep."""

RESTATED = STUDY / "restated.json"
"""How far our versions of shipped controllers are from their sources."""

SINGLE_RAD = 4.0 * 2.0**-22
"""COUNT_RAD for a library of single precision: four units in the last place of pi, 9.5e-7 rad."""

WRONG_AXIS_RAD = 0.1
"""Angle between an answer and the axis beyond which the answer does not point along it: 6 degrees."""

"""An experiment and a perturbation that tests plant in a copy of the tree, and what they ask there."""

from pathlib import Path

EXPERIMENT = "bench/experiments/dropped_experiment.py"
PLANTED = "tasks/conditions/planted_bias.py"
DROPPED_EXPERIMENT, PLANTED_AXIS, ASKED_OF_AXIS = (
    Path(__file__).with_name("planted_texts").joinpath(f"{name}.text").read_text()
    for name in ("dropped_experiment", "planted_axis", "asked_of_axis")
)

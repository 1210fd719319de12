"""Values of the episodes on the free body from starts of the claims' own."""

MATRIX = "rotation-matrix"
RELATIVE = "linearized-euler-relative/zyx-euler"
FEEDBACK = "feedback-linearized/zyx-euler"

GAINS = (
    (100.0, 20.0),
    (25.0, 10.0),
    (400.0, 40.0),
    (100.0, 10.0),
    (100.0, 40.0),
)
"""Critically damped at 10, 5 and 20 rad/s; then damping ratios 1/2 and 2 at 10 rad/s."""

DIRECTIONS = 16
NEAR_GOAL_RAD = 0.3

MARGINS_RAD = (0.01, 0.05, 0.1, 0.2)
SPEED, BESIDE = 20.0, 64
"""rad/s, as fast as the fastest tumbling start; starts at each margin."""

PERTURBED = {
    "wrong-inertia": (
        "inertia",
        100,
        (MATRIX, FEEDBACK),
        ("settling_time_s",),
    ),
    "moving-goal": (
        "moving-goal",
        200,
        (RELATIVE, MATRIX),
        ("angle0_rad", "tail_max_rad"),
    ),
}
"""Probe -> perturbation, starts at each level, laws, and the columns of robustness.parquet that are kept."""

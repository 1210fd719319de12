"""Tables of episodes without contact: how they ended, their curves, where laws first fail, and perturbations."""

from bench.metrics.registry import known_metrics, metrics_of
from bench.tables.column import COUNT, NUMBER, SINGLE, Column, numbers, words
from tasks.verdict import CRASHED, OUTCOMES

CONTENDER = words(
    regulator="the law",
    representation="coordinates the law acts on; empty for a law on R",
    jacobian="Jacobian of the arm; empty for the free body",
    inverse="how the Jacobian is inverted; empty for the free body",
)
PLACE = words(
    suite="plan the row belongs to",
    task="plant and goal",
    arm="manipulator; empty for the free body",
    variation="how the plant differs from the controller's model of it; nominal if it does not",
)
STARTED = [
    *words(engine="what simulated the episode", start_set="family of starts", start_id="start within its family"),
    *numbers("1", "initial orientation, body to base, unit quaternion", "quat_w", "quat_x", "quat_y", "quat_z"),
    *numbers("rad", "Z-Y-X Euler angles of the initial orientation", "alpha0", "beta0", "gamma0"),
    *numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
    *numbers("rad/s", "initial angular velocity, base frame", "omega0_x", "omega0_y", "omega0_z"),
    *numbers("1", "goal orientation, unit quaternion", "goal_quat_w", "goal_quat_x", "goal_quat_y", "goal_quat_z"),
]
SET = [
    *numbers("1/s^2", "position gain", "kp"),
    *numbers("1/s", "velocity gain", "kv"),
    *numbers("s", "control period and integration step", "dt_s"),
    *words(integrator="how the plant is integrated"),
    *numbers("s", "shortest step of integration", "step_s"),
    *words(
        converged="on ideal-rk4 yes or no: whether half the step changes no outcome and moves no settling time by more "
        "than a control period; empty on others"
    ),
    *numbers("s", "longest time simulated", "horizon_s"),
    *numbers("1", "settling band over initial angle", "tolerance"),
    *numbers(
        "s",
        "how long a settled body is at rest, or an early stop under a hundredth of the band",
        "hold_s",
    ),
]
JUDGED = [
    *words(outcome=f"{', '.join(OUTCOMES[:CRASHED])}; of a user's law also {' or '.join(OUTCOMES[CRASHED:])}"),
    *numbers("s", "first time after which the angle stays in the band; null if it does not", "settling_time_s"),
    *numbers("s", "time at which the episode failed; null if it did not", "failure_time_s"),
    *numbers("rad", "angle to the goal at the end, by the judge", "final_angle_rad"),
]
SEEN_ON_ARM = [
    *numbers(
        "1",
        "largest condition number of the tool's Jacobian (SI units), looked at every 8 ticks, by the judge",
        "cond_jacobian_max",
    ),
    *words(
        cause="what a failed episode on an arm was near: representation, kinematic, both, torque or law",
        outcome_beside="on an arm, the other outcome of the same start with its joints turned by 1e-12 rad: rounding "
        "decides; empty if there is none",
    ),
    *numbers(
        "1",
        "largest relative change of this row's numbers by those 1e-12 rad; null if the episode came near no "
        "singularity and no hundredfold rated torque",
        "rounding_change",
    ),
]
TICKS = [Column("ticks", COUNT, "1", "control periods simulated")]


def episode_columns() -> list[Column]:
    """episodes.parquet: one row an episode; every metric found adds its column."""
    measured = [Column(one.column, NUMBER, one.unit, one.title) for one in known_metrics().values()]
    return [*PLACE, *CONTENDER, *STARTED, *SET, *JUDGED, *measured, *SEEN_ON_ARM, *TICKS]


def trace_columns() -> list[Column]:
    """traces.parquet: an episode every few ticks."""
    return [
        *words(task="plant and goal", arm="manipulator; empty for the free body"),
        *CONTENDER,
        *words(engine="what simulated the episode", start_set="family of starts", start_id="start within its family"),
        *numbers("s", "time", "time_s"),
        *numbers("1", "columns of R = [n o a], base frame", *(f"{c}_{x}" for c in "noa" for x in "xyz")),
        *numbers("rad/s", "angular velocity, base frame", "omega_x", "omega_y", "omega_z"),
        *numbers("rad/s^2", "command, base frame", "u_x", "u_y", "u_z"),
        *numbers("rad", "angle to the goal", "angle_rad"),
        *numbers("m", "distance of the tool from its place; null on the free body", "position_error_m"),
        *numbers("rad", "joint angles; null where there is no such joint", *(f"q_{i}" for i in range(1, 8))),
        *(one._replace(meaning=f"of the episode: {one.meaning}; none on an arm") for one in JUDGED),
    ]


def boundary_columns() -> list[Column]:
    """boundaries.parquet: along the geodesic about one axis, where a law first fails."""
    return [
        *CONTENDER,
        *numbers("1", "axis of the initial rotation, base frame", "axis_x", "axis_y", "axis_z"),
        *numbers("rad", "largest angle of the scan below which every start settled", "settled_to_rad"),
        *numbers("rad", "first failing angle, bisected; null if none fails", "fails_from_rad"),
        *words(outcome="how it fails there; empty if it does not"),
    ]


def field_columns() -> list[Column]:
    """command-field.parquet: a law as a function of state, a row a finding (bench/experiments/command_field.py)."""
    return [
        *CONTENDER,
        *words(finding="what was looked at, as stiffness", what="what it is; none if there is nothing of it"),
        *numbers("1", "its size: share of kp or kv; null if there is none", "value"),
        *numbers("1", "least and most of it, over axes", "least", "most"),
        Column("found", COUNT, "1", "in how many states, or on how many geodesics"),
        Column("of", COUNT, "1", "of so many that were looked at"),
        *numbers("1", "orientation that shows it, unit quaternion", "quat_w", "quat_x", "quat_y", "quat_z"),
        *numbers("1", "goal there, unit quaternion", "goal_quat_w", "goal_quat_x", "goal_quat_y", "goal_quat_z"),
        *numbers("rad/s^2", "command there, at rest, base frame", "u_x", "u_y", "u_z"),
    ]


def stream_columns() -> list[Column]:
    """goal-streams.parquet: goals that arrive as a stream (tasks/goal_stream.py), a row a stream and law."""
    return [
        *words(
            stream="how goals are sent and filled in",
            law="the law; empty: 2 K_p vec(q_d q*) - K_v omega, the spring on the quaternion as it came",
        ),
        *numbers("1", "greatest rate of the goal as filled in, over the true goal's", "goal_rate_ratio"),
        *numbers("1", "way that the goal as filled in turns, over the true goal's", "goal_way_ratio"),
        *numbers("rad/s^2", "greatest command", "peak_u"),
        *numbers("rad", "greatest angle of the body to the true goal", "off_rad"),
        *numbers("1", "way that the body turns, over the true goal's", "way_ratio"),
    ]


def spring_columns() -> list[Column]:
    """springs.parquet: rotational springs with a stiffness matrix (bench/contenders/springs), a row a spring and frame.

    K is symmetric with eigenvalues 30, 10 and 3 N m/rad along drawn axes.
    """
    return [
        *words(
            spring="the spring",
            frame="in whose axes its three numbers are taken for a moment: tool or goal",
            potential="whether it has a potential: yes or no",
        ),
        *numbers("1", "stiffness at the goal over that of K, least and most over K's axes", "felt_least", "felt_most"),
        *numbers(
            "1",
            "largest work over a closed way, over what the greatest stiffness stores at the way's furthest angle",
            "work_share",
        ),
        *numbers("1", "the same with K = 10 I", "work_share_isotropic"),
        Column("loops", COUNT, "1", "closed ways that were gone"),
        Column("vanishes", COUNT, "1", "of three, 180° rotations about K's axes at which it vanishes"),
        *numbers("1", "largest change of the energy over a damped motion, over that at its start", "balance_share"),
    ]


def pose_spring_columns() -> list[Column]:
    """pose-springs.parquet: springs of position and orientation (bench/contenders/pose_springs), a row a spring.

    K is symmetric with eigenvalues 30, 10 and 3 N/m along drawn axes, kr is 10 N m/rad; ways are of velocity commands
    with K = I and kr = 1, from uniform orientations, half a metre from the goal.
    """
    return [
        *words(spring="the spring", potential="whether it has a potential: yes or no"),
        *numbers("1", "largest work over a closed way, over what is stored where it is furthest", "work_share"),
        *numbers("1", "the same with K = 10 I", "work_share_isotropic"),
        Column("starts", COUNT, "1", "starts of the ways"),
        *numbers("1", "way of the hand's origin over the straight one: median and most", "way_median", "way_most"),
        *numbers(
            "m", "distance of two ways of one point of the hand at most, the origin drawn 0.2 m elsewhere", "apart_m"
        ),
    ]


def map_columns() -> list[Column]:
    """map.parquet: millions of random starts of a law, counted in cells of SO(3) (`python -m bench map`).

    A row a cell; one for the slowest start of each ring of 5 degrees; one for each start that is lost or does not
    converge, the first thousand of a law and speed. Starts are numbers of a sequence that the seed names.
    """
    return [
        *CONTENDER,
        *words(engine="what simulated the episodes"),
        Column("seed", COUNT, "1", "of the starts"),
        *numbers("rad/s", "initial speeds are uniform between these two", "least_speed", "most_speed"),
        *words(row="cell, slowest or lost"),
        Column("ring_deg", COUNT, "deg", "initial angle to the goal: from this to 5 degrees more"),
        Column("band", COUNT, "1", "z of the axis of the initial turn: 0 to 7, eighths of [-1, 1]"),
        Column("azimuth", COUNT, "1", "its azimuth: 0 to 15, sixteenths of [-pi, pi]"),
        Column("start", COUNT, "1", "number of the start; -1 for a cell"),
        Column("starts", COUNT, "1", "how many"),
        Column("settled", COUNT, "1", "how many of them converged and settled"),
        Column("unconverged", COUNT, "1", "how many did not converge; the others are lost"),
        *numbers("s", "largest settling time of those that settled; null if none did", "settling_time_s"),
        *words(outcome="of a start; empty for a cell"),
        *numbers(
            "1", "orientation of the start, unit quaternion; null for a cell", *(f"quat_{part}" for part in "wxyz")
        ),
        *numbers("rad/s", "its angular velocity, base frame; null for a cell", *(f"omega0_{axis}" for axis in "xyz")),
    ]


def perturbed_columns() -> list[Column]:
    """robustness/perturbed.parquet: the perturbed free body from hundreds of starts, a row a law and level."""
    return [
        *words(
            axis="perturbation: python -m bench list axes",
            regulator="the law",
            representation="coordinates the law acts on; empty for a law on R",
        ),
        *numbers("the axis's", "how much of it", "level"),
        Column("starts", COUNT, "1", "how many, the same for every law"),
        Column("good", COUNT, "1", "of them, those that settled; where it lasts, those left within 3 degrees rms"),
        *numbers("s", "median settling time, those that never settle counted as infinite", "median_s"),
        *numbers("s", "longest settling time of those that settled; null if none did", "longest_s"),
    ]


def robustness_columns() -> list[Column]:
    """robustness.parquet: the perturbed free body, an episode a row; starts and noise are the same for every law.

    The plant moves between commands, which are held; every metric of the free body adds its column, over the plant's
    steps. Of an episode that ended early, what is left in its tail is the final angle.
    """
    measured = [Column(one.column, SINGLE, one.unit, one.title) for one in metrics_of(on_arm=False)]
    left = {
        "tail_rms_rad": ("rad", "root of the mean squared angle to the goal over the last second"),
        "tail_max_rad": ("rad", "largest angle to the goal in the last second"),
        "variation": ("rad/s^2", "variation of the command: sum of |u - u before| over control periods"),
    }
    return [
        *words(
            suite="plan the row belongs to",
            axis="perturbation: python -m bench list axes",
            regulator="the law",
            representation="coordinates the law acts on; empty for a law on R",
        ),
        *numbers("the axis's", "how much of it", "level"),
        *words(start_id="start; the axes' starts are their own"),
        *numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
        *numbers("1/s^2", "position gain", "kp"),
        *numbers("1/s", "velocity gain", "kv"),
        *numbers("s", "control period", "dt_s"),
        *numbers("s", "longest time simulated", "horizon_s"),
        *JUDGED,
        *measured,
        *(Column(name, SINGLE, unit, meaning) for name, (unit, meaning) in left.items()),
    ]

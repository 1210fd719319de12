"""The tables of a run, column by column: type, unit, meaning. results/README.md is generated from here."""

from typing import NamedTuple

import pyarrow as pa

from bench.metrics.registry import known_contact_metrics, known_metrics, metrics_of
from bench.provenance import ROOT

VERSION = "2"
WORD, NUMBER, COUNT = pa.dictionary(pa.int32(), pa.string()), pa.float64(), pa.int64()
SINGLE = pa.float32()
"""Where seven digits are enough: sizes of what is nearly zero, condition numbers, measures of laws in trouble."""


class Column(NamedTuple):
    """One column of a table."""

    name: str
    type: pa.DataType
    unit: str
    meaning: str


def _words(**meanings: str) -> list[Column]:
    return [Column(name, WORD, "", meaning) for name, meaning in meanings.items()]


def _numbers(unit: str, meaning: str, *names: str) -> list[Column]:
    return [Column(name, NUMBER, unit, meaning) for name in names]


CONTENDER = _words(
    regulator="the law",
    representation="coordinates the law acts on; empty for a law on R",
    jacobian="Jacobian of the arm; empty for the free body",
    inverse="how the Jacobian is inverted; empty for the free body",
)
PLACE = _words(
    suite="plan the row belongs to",
    task="plant and goal",
    arm="manipulator; empty for the free body",
    variation="how the plant differs from the controller's model of it; nominal if it does not",
)
STARTED = [
    *_words(engine="what simulated the episode", start_set="family of starts", start_id="start within its family"),
    *_numbers("1", "initial orientation, body to base, unit quaternion", "quat_w", "quat_x", "quat_y", "quat_z"),
    *_numbers("rad", "Z-Y-X Euler angles of the initial orientation", "alpha0", "beta0", "gamma0"),
    *_numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
    *_numbers("rad/s", "initial angular velocity, base frame", "omega0_x", "omega0_y", "omega0_z"),
    *_numbers("1", "goal orientation, unit quaternion", "goal_quat_w", "goal_quat_x", "goal_quat_y", "goal_quat_z"),
]
SET = [
    *_numbers("1/s^2", "position gain", "kp"),
    *_numbers("1/s", "velocity gain", "kv"),
    *_numbers("s", "control period and integration step", "dt_s"),
    *_words(integrator="how the plant is integrated"),
    *_numbers("s", "longest time simulated", "horizon_s"),
    *_numbers("1", "settling band over initial angle", "tolerance"),
    *_numbers("s", "time under a hundredth of the band after which an engine stops early", "hold_s"),
]
JUDGED = [
    *_words(outcome="settled, stuck, timed-out, diverged, singular, saturated; of a user's law also crashed or hung"),
    *_numbers("s", "first time after which the angle stays in the band; null if it does not", "settling_time_s"),
    *_numbers("s", "time at which the episode failed; null if it did not", "failure_time_s"),
    *_numbers("rad", "angle to the goal at the end, by the judge", "final_angle_rad"),
]
SEEN_ON_ARM = [
    *_numbers(
        "1",
        "largest condition number of the tool's Jacobian (SI units), looked at every 8 ticks, by the judge",
        "cond_jacobian_max",
    ),
    *_words(
        cause="what a failed episode on an arm was near: representation, kinematic, both, torque or law",
        outcome_beside="on an arm, the other outcome of the same start with its joints turned by 1e-12 rad: rounding "
        "decides; empty if there is none",
    ),
    *_numbers(
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


KEY = (
    *("suite", "task", "arm", "variation"),
    *("regulator", "representation", "jacobian", "inverse"),
    *("engine", "start_set", "start_id"),
)
"""What names a row of episodes.parquet; kp, kv, dt_s and integrator are the run's."""


def trace_columns() -> list[Column]:
    """traces.parquet: an episode every few ticks."""
    return [
        *_words(task="plant and goal", arm="manipulator; empty for the free body"),
        *CONTENDER,
        *_words(engine="what simulated the episode", start_set="family of starts", start_id="start within its family"),
        *_numbers("s", "time", "time_s"),
        *_numbers("1", "columns of R = [n o a], base frame", *(f"{c}_{x}" for c in "noa" for x in "xyz")),
        *_numbers("rad/s", "angular velocity, base frame", "omega_x", "omega_y", "omega_z"),
        *_numbers("rad/s^2", "command, base frame", "u_x", "u_y", "u_z"),
        *_numbers("rad", "angle to the goal", "angle_rad"),
        *_numbers("m", "distance of the tool from its place; null on the free body", "position_error_m"),
        *_numbers("rad", "joint angles; null where there is no such joint", *(f"q_{i}" for i in range(1, 8))),
        *(one._replace(meaning=f"of the episode: {one.meaning}; none on an arm") for one in JUDGED),
    ]


def boundary_columns() -> list[Column]:
    """boundaries.parquet: along the geodesic about one axis, where a law first fails."""
    return [
        *CONTENDER,
        *_numbers("1", "axis of the initial rotation, base frame", "axis_x", "axis_y", "axis_z"),
        *_numbers("rad", "largest angle of the scan below which every start settled", "settled_to_rad"),
        *_numbers("rad", "first failing angle, bisected; null if none fails", "fails_from_rad"),
        *_words(outcome="how it fails there; empty if it does not"),
    ]


def pose_columns() -> list[Column]:
    """poses.parquet: Jacobians of an arm, a row a pose and representation; metres and radians."""
    singles = {
        "condition": "condition number of J, by the judge",
        "kernel_gap": "largest difference between our J and the judge's, over the largest element",
        "det": "determinant of J; null unless it is six by six",
        "margin": "of the representation: 0 on its singular set",
        "condition_analytic": "condition number of J_E = diag(I, B^-1) J, over six singular values",
        "largest": "largest element of J_E's rows of orientation, in size",
        "det_analytic": "determinant of J_E; null unless it is six by six",
        "det_gap": "Z-Y-X: |det J_E + det J / cos(beta)|, our J, over the product of J_E's row norms",
        "derivation_gap": "largest difference between J_E converted and differentiated, over the largest element; on a "
        "slice of Z-Y-X alone",
        "difference_gap": "Z-Y-X, but on a slice: likewise, J_E and central differences of the judge's kinematics",
    }
    return [
        *_words(
            arm="manipulator",
            pose_set="named, random, slice or pole",
            pose_id="pose within its set",
            representation="coordinates of J_E",
        ),
        *_numbers("rad", "joint angles; null where there is no such joint", *(f"q_{i}" for i in range(1, 8))),
        *_numbers("rad", "Z-Y-X angle beta of the tool", "beta"),
        *(Column(name, SINGLE, "1", meaning) for name, meaning in singles.items()),
    ]


COMPLIANCE_KEY = ("suite", "task", "arm", "controller", "representation", "form", "pose")
"""What names a row of compliance.parquet."""


def compliance_columns() -> list[Column]:
    """compliance.parquet: a hand in contact, a row a pose and controller; every contact metric found adds its column.

    Null where a number has no meaning: a metric of another task, or of an episode that broke off too early.
    """
    measured = [Column(one.column, NUMBER, one.unit, one.title) for one in known_contact_metrics().values()]
    about = "measured rotation about {} per moment about {}, base frame; least squares over the pose's small moments"
    return [
        *_words(
            suite="plan the row belongs to",
            task="what the hand does",
            arm="manipulator",
            controller="hybrid control along axes of the base or the hand, or coordinates; or an impedance",
            representation="coordinates the controller acts on; empty for none",
            form="inverse or projected: how a hybrid controller's rows become motion of the joints; empty for others",
            pose="where the hand is, and what it is told",
            complies="what the order lets comply; an impedance complies along and about all axes whatever it says",
        ),
        *_numbers("rad", "Z-Y-X Euler angles of the hand's goal", "alpha", "beta", "gamma"),
        *_numbers("rad", "angle by which the surroundings differ from what the order supposes", "tilt"),
        *_numbers("1/s^2", "position gain", "kp"),
        *_numbers("1/s", "velocity gain", "kv"),
        *_numbers("kg", "apparent mass", "m_p"),
        *_numbers("kg m^2", "apparent inertia", "m_o"),
        *_numbers("1/s", "damping of what complies", "kc"),
        *_numbers("s", "control period and integration step", "dt_s"),
        *_words(integrator="how the plant is integrated"),
        *_numbers("s", "time simulated", "horizon_s"),
        Column("trials", COUNT, "1", "episodes of the pose"),
        *_words(outcome="the worst of its episodes: done, singular, saturated, diverged or broken (MuJoCo gave up)"),
        *_numbers("s", "time at which the first of the worst episodes failed; null if all are done", "failure_time_s"),
        *measured,
        *(Column(f"c_{i}{j}", NUMBER, "rad/(N m)", about.format(i, j)) for i in "xyz" for j in "xyz"),
    ]


ROBUSTNESS_KEY = ("suite", "axis", "level", "regulator", "representation", "start_id")
"""What names a row of robustness.parquet."""


def robustness_columns() -> list[Column]:
    """robustness.parquet: the free body in trouble, an episode a row; starts and noise are the same for every law.

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
        *_words(
            suite="plan the row belongs to",
            axis="kind of trouble: python -m bench list axes",
            regulator="the law",
            representation="coordinates the law acts on; empty for a law on R",
        ),
        *_numbers("the axis's", "how much of it", "level"),
        *_words(start_id="start; the axes' starts are their own"),
        *_numbers("rad", "initial angle to the goal, by the judge", "angle0_rad"),
        *_numbers("1/s^2", "position gain", "kp"),
        *_numbers("1/s", "velocity gain", "kv"),
        *_numbers("s", "control period", "dt_s"),
        *_numbers("s", "longest time simulated", "horizon_s"),
        *JUDGED,
        *measured,
        *(Column(name, SINGLE, unit, meaning) for name, (unit, meaning) in left.items()),
    ]


def cost_columns() -> list[Column]:
    """costs.parquet: operations a tick, by stage and branch."""
    from bench.counting import OPERATIONS

    return [
        *CONTENDER,
        Column("joints", COUNT, "1", "joints of the arm; 0 on the free body, where a law is all there is"),
        *_words(branch="typical or worst", stage="part of the tick, or total"),
        *(Column(name, COUNT, "1", f"{name} operations a tick") for name in OPERATIONS),
        Column("flops", COUNT, "1", "add + mul + div + sqrt; transcendental functions apart"),
    ]


def timing_columns() -> list[Column]:
    """timings/<machine>.parquet: one row for everything timed, in one run whose passes visit all of it."""
    return [
        *_words(
            what="law (alone), engine (a whole loop), loop (the empty loop that every law's time holds), or threads "
            "(two against one, on the wall)",
            arm="manipulator; empty for a law alone and for the free body",
            regulator="the law; empty for the empty loop and for rollout",
            representation="coordinates the law acts on; empty for a law on R",
            jacobian="Jacobian of the arm; empty for the free body",
            inverse="how the Jacobian is inverted; empty for the free body",
            engine="ideal-held, ideal-rk4, native, rollout (mujoco.rollout, open loop) or dm-control (its "
            "Environment.step and the law in numpy); empty for a law alone",
        ),
        *_numbers("ns", "CPU time a tick, median over passes; of threads: time on the wall of two", "ns_per_tick"),
        *_numbers("ns", "CPU time of one step of the reference kernel, median over passes", "ns_reference_kernel"),
        *_numbers("1", "time a tick over the kernel's step of the same pass, median over passes", "ratio"),
        *_numbers("1", "interval of that median, 95 % by order statistics", "ratio_low", "ratio_high"),
        *_numbers(
            "1", "native, dm-control: time a tick over rollout's of the same pass, median over passes", "ratio_rollout"
        ),
        *_numbers("1", "interval of that median, 95 % by order statistics", "ratio_rollout_low", "ratio_rollout_high"),
        *_numbers(
            "1", "dm-control: its time a tick over native's of the same pass; threads: one's time over two's", "speedup"
        ),
        *_numbers("1", "interval of that median, 95 % by order statistics", "speedup_low", "speedup_high"),
        Column("passes", COUNT, "1", "passes; of threads: repetitions"),
        Column("ticks", COUNT, "1", "ticks of one round; 0 if the law fails and could not be timed"),
    ]


def library_columns() -> list[Column]:
    """libraries/libraries.parquet: what robot libraries say at the same turns, a row a function and set."""
    counts = {
        "turns": "how many were asked for",
        "raised": "of them, those that raised an error",
        "not_finite": "those answered with what is no number",
        "nought": "those answered with less than a millionth of the angle",
        "long_way": "those answered with a vector that points the long way round",
        "astray": "those answered with a vector more than 0.1 rad off the axis",
        "other_sheet": "those answered otherwise when given as -q, for functions that take quaternions",
    }
    return [
        *_words(
            library="who is asked",
            version="of its package",
            function="what is asked, with the factor that makes it theta k near the identity",
            takes="matrix or quaternion",
            form="what it means to be: a word of bench/studies/libraries/forms.py",
            turn_set="family of turns: bench/studies/libraries/turns.py",
        ),
        *_numbers("rad", "angle of every turn of the set; null if they differ", "angle_rad"),
        *_numbers("rad", "how much every turn of the set is short of half a turn; null if they differ", "distance_rad"),
        *(Column(name, COUNT, "1", meaning) for name, meaning in counts.items()),
        *_numbers("rad", "largest |e - theta k|, theta and k known; null if no answer is a number", "error_rad"),
        *_numbers("rad", "largest error against its own closed form; of angles, of the turn rebuilt", "form_error_rad"),
        *_numbers("rad", "largest and smallest |e|", "largest_rad", "smallest_rad"),
    ]


TABLES = {
    "episodes": episode_columns,
    "costs": cost_columns,
    "traces": trace_columns,
    "boundaries": boundary_columns,
    "poses": pose_columns,
    "compliance": compliance_columns,
    "robustness": robustness_columns,
    "timings": timing_columns,
    "libraries": library_columns,
}


def arrow_schema(table: str) -> pa.Schema:
    """The schema of a table with units and meanings as column metadata."""
    fields = [
        pa.field(one.name, one.type, metadata={"unit": one.unit, "meaning": one.meaning}) for one in TABLES[table]()
    ]
    return pa.schema(fields, metadata={"orientation-bench table": table, "orientation-bench schema": VERSION})


def readme() -> str:
    """results/README.md: every table, column, unit and meaning."""
    lines = [
        "# Results",
        "",
        "Generated by `make reference` from `bench/tables/schema.py`; do not edit.",
        "",
        "`reference/` is committed and small: what `make check` compares with. `latest/` is what `make bench` wrote",
        "last. `timings/` holds one file for each kind of machine, `libraries/` what other robot libraries answered",
        "(`make libraries`), `scale/` what many episodes cost (`python -m bench.studies.scale`). Every table is",
        "parquet, its units are in the columns' metadata, and `provenance.json` says where a run comes from.",
    ]
    for table, columns in TABLES.items():
        lines += ["", f"## {table}.parquet", "", (columns.__doc__ or "").strip(), ""]
        lines += ["| column | unit | meaning |", "| --- | --- | --- |"]
        lines += [f"| {one.name} | {one.unit} | {one.meaning} |" for one in columns()]
    return "\n".join(lines) + "\n"


RESULTS = ROOT / "results"

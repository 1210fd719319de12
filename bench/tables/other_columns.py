"""Tables of everything else: a hand in contact, poses, operations, times, and other libraries."""

from bench.metrics.registry import known_contact_metrics
from bench.tables.column import COUNT, NUMBER, SINGLE, Column, numbers, words
from bench.tables.motion_columns import CONTENDER


def compliance_columns() -> list[Column]:
    """compliance.parquet: a hand in contact, a row a pose and controller; every contact metric found adds its column.

    Null where a number has no meaning: a metric of another task, or of an episode that broke off too early.
    """
    measured = [Column(one.column, NUMBER, one.unit, one.title) for one in known_contact_metrics().values()]
    about = "measured rotation about {} per moment about {}, base frame; least squares over the pose's small moments"
    return [
        *words(
            suite="plan the row belongs to",
            task="what the hand does",
            arm="manipulator",
            controller="hybrid control along axes of the base or the hand, or coordinates; or an impedance",
            representation="coordinates the controller acts on; empty for none",
            form="inverse, projected or transpose: how a hybrid controller's rows become torques; empty for others",
            pose="where the hand is, and what is asked of it",
            complies="what the order lets comply; an impedance complies along and about all axes whatever it says",
        ),
        *numbers("rad", "Z-Y-X Euler angles of the hand's goal", "alpha", "beta", "gamma"),
        *numbers("rad", "angle by which the surroundings differ from what the order supposes", "tilt"),
        *numbers("1/s^2", "position gain", "kp"),
        *numbers("1/s", "velocity gain", "kv"),
        *numbers("kg", "apparent mass", "m_p"),
        *numbers("kg m^2", "apparent inertia", "m_o"),
        *numbers("1/s", "damping of what complies", "kc"),
        *numbers("1", "gain on the error of force, of the form transpose", "kf"),
        *numbers("s", "control period and integration step", "dt_s"),
        *words(integrator="how the plant is integrated"),
        *numbers("s", "time simulated", "horizon_s"),
        Column("trials", COUNT, "1", "episodes of the pose"),
        *words(outcome="the worst of its episodes: done, singular, saturated, diverged or broken (MuJoCo gave up)"),
        *words(rest="at-rest or creeping (not at rest by the horizon); empty of tasks without an end, and failures"),
        *numbers("s", "time at which the first of the worst episodes failed; null if all are done", "failure_time_s"),
        *measured,
        *(Column(f"c_{i}{j}", NUMBER, "rad/(N m)", about.format(i, j)) for i in "xyz" for j in "xyz"),
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
        *words(
            arm="manipulator",
            pose_set="named, random, slice or pole",
            pose_id="pose within its set",
            representation="coordinates of J_E",
        ),
        *numbers("rad", "joint angles; null where there is no such joint", *(f"q_{i}" for i in range(1, 8))),
        *numbers("rad", "Z-Y-X angle beta of the tool", "beta"),
        *(Column(name, SINGLE, "1", meaning) for name, meaning in singles.items()),
    ]


def cost_columns() -> list[Column]:
    """costs.parquet: operations a tick, by stage and branch."""
    from bench.counting import OPERATIONS

    return [
        *CONTENDER,
        Column("joints", COUNT, "1", "joints of the arm; 0 on the free body, where a law is all there is"),
        *words(branch="typical or worst", stage="part of the tick, or total"),
        *(Column(name, COUNT, "1", f"{name} operations a tick") for name in OPERATIONS),
        Column("flops", COUNT, "1", "add + mul + div + sqrt; transcendental functions apart"),
    ]


def timing_columns() -> list[Column]:
    """timings/<machine>.parquet: one row for everything timed, in one run whose passes visit all of it."""
    return [
        *words(
            what="law (alone), controller (kinematics, D, fg, law, Jacobian and inverse, without plant and judge), "
            "engine (a whole loop), loop (the empty loop that every law's time holds), or threads (two against one, on "
            "the wall)",
            arm="manipulator; empty for a law alone and for the free body",
            regulator="the law; empty for the empty loop and for rollout",
            representation="coordinates the law acts on; empty for a law on R",
            jacobian="Jacobian of the arm; empty for the free body",
            inverse="how the Jacobian is inverted; empty for the free body",
            engine="ideal-held, ideal-rk4, native, rollout (mujoco.rollout, open loop) or dm-control (its "
            "Environment.step and the law in numpy); empty for a law alone",
        ),
        *numbers("ns", "CPU time a tick, median over passes; of threads: time on the wall of two", "ns_per_tick"),
        *numbers("ns", "CPU time of one step of the reference kernel, median over passes", "ns_reference_kernel"),
        *numbers("1", "time a tick over the kernel's step of the same pass, median over passes", "ratio"),
        *numbers("1", "interval of that median, 95 % by order statistics", "ratio_low", "ratio_high"),
        *numbers(
            "1", "native, dm-control: time a tick over rollout's of the same pass, median over passes", "ratio_rollout"
        ),
        *numbers("1", "interval of that median, 95 % by order statistics", "ratio_rollout_low", "ratio_rollout_high"),
        *numbers(
            "1", "dm-control: its time a tick over native's of the same pass; threads: one's time over two's", "speedup"
        ),
        *numbers("1", "interval of that median, 95 % by order statistics", "speedup_low", "speedup_high"),
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
        *words(
            library="who is asked",
            version="of its package",
            function="what is asked, with the factor that makes it theta k near the identity",
            kind="function: the library offers it; idiom: users write it on functions of the library",
            takes="matrix or quaternion",
            form="what it means to be: a word of bench/studies/libraries/forms.py",
            precision="double, or single by design of the library",
            thread="where the fault is known upstream: owner/repository#number; empty if no thread was found",
            turn_set="family of turns: bench/studies/libraries/turns.py",
        ),
        *numbers("rad", "angle of every turn of the set; null if they differ", "angle_rad"),
        *numbers("rad", "how much every turn of the set is short of half a turn; null if they differ", "distance_rad"),
        *(Column(name, COUNT, "1", meaning) for name, meaning in counts.items()),
        *numbers("rad", "largest |e - theta k|, theta and k known; null if no answer is a number", "error_rad"),
        *numbers("rad", "largest error against its own closed form; of angles, of the turn rebuilt", "form_error_rad"),
        *numbers(
            "rad", "largest angle to the turn that an answer stands for, or excess over the short way", "turn_error_rad"
        ),
        *numbers("rad", "largest and smallest |e|", "largest_rad", "smallest_rad"),
    ]


def closed_loop_columns() -> list[Column]:
    """libraries/closed_loop.parquet: libraries' errors and controllers on the free body, a row an angle and sheet."""
    counts = {
        "starts": "how many",
        "settled": "of them, those that settled as the judge says (tasks/rules.py)",
        "dead": "those that never move: at rest, and the command exactly zero",
        "lost": "those that had not settled at the horizon",
        "failed": "those for which no number came",
        "away": "those that turned away from the goal by more than a degree before they came to it",
    }
    return [
        *words(
            library="who is asked",
            version="of its package; of a controller that is restated, the commit that was read",
            function="its error, or its controller",
            kind="function or idiom: its error in u = kp e - kv omega; controller: as its users run it; our-loop: "
            "with their error and gains, in a loop written here; restated: by its source",
            title="of a controller: what is run, with its gains",
            error="the function that it takes for its error; itself but for controllers",
            command="acceleration or velocity",
            sheet="near: from the quaternion whose scalar is not negative; antipode: from the other one",
        ),
        *numbers("deg", "angle of the starts; at 180 exactly", "angle_deg"),
        *(Column(name, COUNT, "1", meaning) for name, meaning in counts.items()),
        *numbers("s", "settling time of the fastest and of the slowest that settled", "fastest_s", "slowest_s"),
        *numbers("1", "stiffness felt near the goal over the one set; null for controllers", "stiffness_ratio"),
        *numbers(
            "1", "acceleration from rest over its slope at 1 deg, where it is no multiple of an error", "pull_ratio"
        ),
    ]


def verdict_columns() -> list[Column]:
    """libraries/verdicts.parquet: what `bench audit` says of each function, and what replaces it, a row a function."""
    return words(
        library="who is asked",
        version="of its package; of a controller that is restated, the commit that was read",
        function="its error",
        takes="matrix or quaternion",
        convention="what it means by its three numbers, as the audit found",
        faults="names of its faults, with commas between; empty if it has none",
        replacement="the smallest change that cures it, or a function of replacements.py; empty if it needs none",
        replacement_faults="what the audit says of that one",
        fixed="faults that an earlier version had and this one has not",
        fixed_since="that earlier version",
    )

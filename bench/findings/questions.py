"""Questions that users of robot libraries asked in public: cause, cure, and a number without and with the cure."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from bench.findings import measured_questions as measured


class Question(NamedTuple):
    """A public thread; its first one names it.

    threads: owner/repository#number. quantity: what measure() returns, without and with the cure; it is right where it
    differs from `right` by at most `tolerance`.
    """

    title: str
    threads: tuple[str, ...]
    cause: str
    cure: str
    quantity: str
    measure: Callable[[], tuple[float, float]]
    right: float = 0.0
    tolerance: float = 1e-6


QUESTIONS = (
    Question(
        "Vector part or rotation vector? Torques flip",
        ("epfl-lasa/control-libraries#332", "aica-technology/control-libraries#116"),
        "The vector part is sin(θ/2) k, half of the angle near the goal; q and −q are one orientation.",
        "Negate q if w < 0, then 2 atan2(|v|, w) v/|v|.",
        "torque over K times the angle, at 90° and w < 0",
        measured.measure_vector_part,
        right=1.0,
    ),
    Question(
        "Which Jacobian goes with which error?",
        ("ethz-adrl/control-toolbox#190", "google-deepmind/mujoco#89", "jrl-umi3218/RBDyn#84"),
        "The geometric Jacobian gives ω. A difference of Euler angles is no vector of that frame: ω = B(E) Ė.",
        "With the geometric Jacobian use the logarithm, or B times the difference.",
        "command off the axis to the goal, at β = 60° [deg]",
        measured.measure_angle_difference,
        tolerance=0.1,
    ),
    Question(
        "The axis is zero at 180°",
        ("RobotLocomotion/drake#3451", "RobotLocomotion/drake#601"),
        "The axis is taken from R − Rᵀ, which vanishes at 180°.",
        "Convert R to a quaternion by its largest element, and take the axis from that.",
        "R off the rotation rebuilt from axis and angle [deg]",
        measured.measure_axis_of_180_degrees,
    ),
    Question(
        "Units of the impedance example",
        ("frankarobotics/franka_ros#215",),
        "Its error is a quaternion's vector part, half of the angle: K/2 acts. D = 2 √K is critical for I = 1 kg m².",
        "Use the logarithm [rad] and D = 2 √(K I), with the inertia about the axis.",
        "damping ratio, I = 0.1 kg m²",
        measured.measure_damping_ratio,
        right=1.0,
    ),
    Question(
        "(w, x, y, z) or (x, y, z, w)?",
        ("isaac-sim/IsaacLab#5186", "isaac-sim/IsaacLab#5754"),
        "Four numbers of unit length are a rotation in either order, so nothing fails.",
        "Name the order where a quaternion enters (scalar_first of scipy); `bench audit` finds it.",
        "identity off itself when read [deg]",
        measured.measure_quaternion_order,
    ),
    Question(
        "Inverse kinematics do not converge to 1e-6",
        tuple(f"orocos/orocos_kinematics_dynamics#{number}" for number in (199, 109, 139)),
        "The cosine is flat near 0: a last bit of the trace is 1e-8 rad.",
        "θ = atan2(|v|, c) with v from R − Rᵀ and c from the trace; near 180° a quaternion.",
        "relative error of an angle of 1e-9 rad",
        measured.measure_arc_cosine,
    ),
    Question(
        "Rotational stiffness oscillates",
        ("lbr-stack/lbr_fri_ros2_stack#247", "matthias-mayr/Cartesian-Impedance-Controller#30"),
        "D = 2 √K is for unit inertia; without inertia shaping the inertia is the arm's.",
        "D = 2 √(K I) about one axis, double diagonalization of Λ and K about all.",
        "overshoot of a step, I = 10 kg m² [%]",
        measured.measure_overshoot,
    ),
    Question(
        "The gripper tumbles between two goals of a policy",
        tuple(f"huggingface/lerobot#{number}" for number in (3691, 3710, 4002)),
        "Near 180° two neighbouring orientations have rotation vectors of opposite signs, whose components pass zero.",
        "R₀ exp(s log(R₀ᵀ R₁)), or the twin that is nearer to the last vector.",
        "highest rate of the filled-in goal [rad/s]",
        measured.measure_goal_rate,
        right=1.0,
        tolerance=1.0,
    ),
    Question(
        "A positive rotation turns backwards",
        tuple(f"mani-skill/ManiSkill#{number}" for number in (1469, 1472, 1435)),
        "The action, between −1 and 1, is multiplied by the lower bound, which is negative.",
        "Multiply by the upper bound.",
        "error after 20 steps over that at the start",
        measured.measure_scaled_action,
        tolerance=0.2,
    ),
    Question(
        "A tolerance box of which numbers?",
        tuple(f"moveit/moveit_msgs#{number}" for number in (82, 89, 96)),
        "The message says axis and angle, one planner takes roll, pitch and yaw, another a rotation vector.",
        "Say which: for a free rotation about z the angles X-Y-Z, whose first two are the tilt.",
        "first two numbers over the tilt, after 170° about z",
        measured.measure_tolerance_box,
        right=1.0,
        tolerance=0.01,
    ),
    Question(
        "A limit changes the direction",
        ("RobotControlStack/robot-control-stack#141",),
        "Each component is clipped on its own.",
        "Shorten the vector to the limit and keep its direction.",
        "command off its direction [deg]",
        measured.measure_clipped_direction,
    ),
    Question(
        "Stiffness in which frame?",
        ("ros-controls/ros2_controllers#1178", "ros-controls/ros2_controllers#1139"),
        "Three numbers on a diagonal are a matrix in one frame; used in another they are another spring.",
        "Rotate the matrix too: R K Rᵀ, for mass, damping and stiffness alike.",
        "torque off the intended one, frame rotated by 60° [deg]",
        measured.measure_stiffness_frame,
    ),
    Question(
        "A masked axis disturbs the others",
        ("stack-of-tasks/tsid#118", "gbionics/bipedal-locomotion-framework#356"),
        "Striking one component of the logarithm leaves the others rotated by half of the angle about that axis.",
        "Use an error of two degrees of freedom, z × z_d.",
        "command off the shortest rotation, 120° about the masked axis [deg]",
        measured.measure_masked_axis,
    ),
    Question(
        "The arm flips between two waypoints",
        ("UniversalRobots/Universal_Robots_ROS_Driver#540",),
        "Quaternions are interpolated by component, although q and −q are one orientation.",
        "If q₀ · q₁ < 0 take −q₁; then slerp.",
        "middle off the shortest path, waypoints 60° apart [deg]",
        measured.measure_interpolation,
    ),
)

"""PX4's attitude loop: a cascade on the tilt of the body's z axis and a yaw, which has a weight.

    u = Kv (omega_c - omega)

The turn from R to R_d is, in body axes, the least turn of the z axis a to its goal a_d, and then a
turn psi about a_d. The law scales psi by YAW_WEIGHT. (eta, eps) is the quaternion of both turns
together, eta >= 0. With p = Kp/Kv

    omega_c = 2 p (eps_x, eps_y, eps_z/YAW_WEIGHT)      each component cut to its greatest rate

So the yaw bends the tilt less: (eps_x, eps_y) is YAW_WEIGHT psi/2 off the axis of the least turn,
and psi/2 off it in the quaternion of the whole turn. The division keeps the stiffness Kp about z.
The greatest rates are those of PX4 over its gains: 220 deg/s over 4.0 1/s about x and y, 200 deg/s
over 2.8 1/s about z. Where a and a_d are opposite, no least turn exists, and the law uses the whole
turn. PX4 tests two components of the least turn for this, in base axes. The test of its length is
ours, so that no base frame is special. Equal gains on all axes are ours too, because all laws here
have equal gains. In PX4 the yaw is slower than the tilt because its gain is smaller; here it is not
slower.

Source: PX4, src/modules/mc_att_control/AttitudeControl/AttitudeControl.cpp at 305966ee and
129a2ae6, and its parameters, mc_att_control_params.yaml at 01486656 (all read). The law here has no
feedforward of the yaw rate and no reference model.

Limitations: at 180° the command jumps to its opposite. Each component has its own limit, so that a
large turn does not keep its axis. The law limits the rate, and knows no bound of the command: where
the motor is weak, the body passes the goal. Near a tilt of 180° psi changes fast with the
orientation, and so does the command.
"""

from bench.law import (
    ADAPTED,
    Display,
    Law,
    Look,
    acos,
    atan2,
    cos,
    kernel,
    quaternion_direction,
    relative,
    rotate,
    sin,
    spring_damper,
    sqrt,
)

YAW_WEIGHT = 0.4
"""Weight of the turn about a_d; PX4's MC_YAW_WEIGHT."""
OPPOSITE = 2e-5
"""cos^2 of half the tilt below which the whole turn is used: PX4's sin > 1 - 1e-5.

That is a tilt above 179.49 degrees.
"""
DEGREE = acos(-1.0) / 180.0
TILT_RATE = 220.0 * DEGREE / 4.0
"""Greatest rate about x and y, over Kp/Kv: 0.96."""
YAW_RATE = 200.0 * DEGREE / 2.8
"""Greatest rate about z, over Kp/Kv: 1.247."""


@kernel
def cut(rate, greatest):
    """Return the rate, or the greatest one in its direction."""
    within = rate
    if rate > greatest:
        within = greatest
    if rate < -greatest:
        within = -greatest
    return within


@kernel
def weigh_yaw(w, x, y, z, t):
    """Return the vector part of the turn with YAW_WEIGHT psi for psi, of length 2 sqrt(t) |eps|.

    The turn is (c, s_x, s_y, 0) (cos(psi/2), 0, 0, sin(psi/2)), so that psi/2 is the angle of
    (w, z). The part in the plane of x and y turns by the part of psi/2 that is dropped.
    """
    square = w * w + z * z
    weighed = (x, y, z)
    if square > OPPOSITE * (4.0 * t):
        half_yaw = atan2(z, w)
        dropped = (1.0 - YAW_WEIGHT) * half_yaw
        c = cos(dropped)
        s = sin(dropped)
        weighed = (c * x - s * y, s * x + c * y, sqrt(square) * sin(YAW_WEIGHT * half_yaw))
    return weighed


@kernel
def law(R, omega, goal, gains):
    """u = Kv (R omega_c - omega), omega_c = 2 p (eps_x, eps_y, eps_z/YAW_WEIGHT), cut, in body."""
    (w, x, y, z), t = quaternion_direction(relative(R, goal.R))
    v = weigh_yaw(w, x, y, z, t)
    p = gains.kp / gains.kv
    scale = p / sqrt(t)
    rate_body = (
        cut(scale * v[0], TILT_RATE * p),
        cut(scale * v[1], TILT_RATE * p),
        cut(scale * v[2] / YAW_WEIGHT, YAW_RATE * p),
    )
    return spring_damper(gains.kv, rotate(R, rate_body), gains.kv, omega)


REGULATOR = Law(
    name="px4",
    title="PX4 attitude loop",
    source=(
        "after the file AttitudeControl.cpp of PX4 (we read it); equal gains on all axes are ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_v\Bigl(\operatorname{sat}_{\omega_{\max}}\bigl(2 \tfrac{K_p}{K_v}"
    r"(\epsilon_x, \epsilon_y, \epsilon_z/w)\bigr) - \omega\Bigr), \quad \psi \to w\,\psi",
    law=law,
    is_beyond_the_paper=True,
    display=Display("PX4", Look("vermillion", "d", "solid"), "On the quaternion"),
)

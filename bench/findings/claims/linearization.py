"""C44 to C46: the linearizations (2.2) and (2.14), and what the Euler Jacobian simplifies (Murphy 1988, 2, 3)."""

import functools

import numpy as np

import tasks
from bench.findings.claims import adequacy, probes
from bench.findings.claims.controller_costs import BY_COMMON, BY_EULER, INVERSES, ON_MATRIX, controller_costs
from bench.findings.claims.standing import ORDERED, by_columns
from bench.findings.claims.tables import Results, evidence
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of
from bench.law.contenders.registry import representation

LIMIT = read_limits(__file__)


@claim("C44")
def c44(results: Results) -> tuple[Word, Evidence]:
    """Accelerations of the hand under (2.2), with the arm's own model and with a wrong one."""
    arms = [name for name in LIMIT.ARMS if tasks.arm(name).joints == 6]
    right, wrong = (
        [results.found_by(accelerations, arm, one, results.seed) for arm in arms] for one in ("", LIMIT.OFF)
    )
    exact, off = (max(float(gaps.max()) for gaps in found) for found in (right, wrong))
    typical = float(np.median(np.concatenate(wrong)))
    return word_of(exact <= LIMIT.SAME < off, False), evidence(
        f"""At {LIMIT.POSES} random states each of {", ".join(arms)} the hand's acceleration, from MuJoCo's forward
        dynamics and differences of its velocity, is u to {exact:.0e} of its size. With all masses
        {LIMIT.OFF.partition("-")[2]} times the model's it misses u by {typical:.0%}, in the median.""",
        2 * LIMIT.POSES * len(arms),
    )


@functools.cache
def accelerations(name: str, variation: str, seed: int) -> np.ndarray:
    """Compute |xddot - u| / |u| of an arm under (2.2) at random states; a variation makes the plant another one."""
    import mujoco

    from tasks.arm_model import model_xml
    from tasks.kinematics import Kinematics

    arm = tasks.arm(name)
    judge, plant = Kinematics(arm), mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    if variation:
        tasks.variation(variation).apply(plant, arm.rated)
    model, jacobian = judge.model, judge.jacobian
    data, body = mujoco.MjData(model), mujoco.MjData(plant)
    rng, gaps = np.random.default_rng(seed), []
    for _ in range(LIMIT.POSES):
        q = np.array(arm.home) + rng.uniform(-LIMIT.AROUND_RAD, LIMIT.AROUND_RAD, model.nv)
        qdot, u = rng.uniform(-1.0, 1.0, model.nv), rng.uniform(-1.0, 1.0, 6)
        J = jacobian(q)
        Jdot = (jacobian(q + LIMIT.STEP_S * qdot) - jacobian(q - LIMIT.STEP_S * qdot)) / (2 * LIMIT.STEP_S)
        data.qpos[:], data.qvel[:] = q, qdot
        mujoco.mj_forward(model, data)
        fg = data.qfrc_bias - data.qfrc_passive
        body.qpos[:], body.qvel[:] = q, qdot
        body.qfrc_applied[:] = judge.inertia_matrix(q) @ np.linalg.solve(J, u - Jdot @ qdot) + fg
        mujoco.mj_forward(plant, body)
        ends = []
        for t in (-LIMIT.STEP_S, LIMIT.STEP_S):  # J(q) qdot along the motion that follows, to second order in t
            ends.append(jacobian(q + t * qdot + t * t / 2 * body.qacc) @ (qdot + t * body.qacc))
        gaps.append(np.linalg.norm((ends[1] - ends[0]) / (2 * LIMIT.STEP_S) - u) / np.linalg.norm(u))
    return np.array(gaps)


@claim("C45")
def c45(results: Results) -> tuple[Word, Evidence]:
    """Derivatives of (2.11) at zero against (2.14)."""
    zero, h = np.zeros(3), LIMIT.STEP

    def slope(place: int) -> np.ndarray:
        columns = []
        for unit in np.eye(3):
            ends = [
                angular_acceleration(*(sign * h * unit if i == place else zero for i in range(3))) for sign in (1, -1)
            ]
            columns.append((ends[0] - ends[1]) / (2 * h))
        return np.array(columns).T

    by_angles, by_rates, by_input = map(slope, range(3))
    off = float(np.abs(by_input - np.eye(3)[::-1]).max())
    rest = float(max(np.abs(by_angles).max(), np.abs(by_rates).max()))
    return word_of(max(off, rest) <= LIMIT.DIFFERENCED, False), evidence(
        f"""Central differences of (2.11) at zero: by u the permutation of (2.14) to {off:.0e}; by the angles and their
        rates zero to {rest:.0e}.""",
        2 * 9,
    )


def angular_acceleration(E: np.ndarray, rates: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Compute Eddot = B^-1 (u - Bdot Edot), which is (2.11), with Bdot by differences along the motion."""
    to_matrix = representation("zyx-euler").to_matrix

    def B(angles: np.ndarray) -> np.ndarray:
        return probes.euler_B(to_matrix(tuple(angles.tolist())))

    h = LIMIT.STEP
    Bdot = (B(E + h * rates) - B(E - h * rates)) / (2 * h)
    return np.linalg.solve(B(E), u - Bdot @ rates)


@claim("C46")
def c46(results: Results) -> tuple[Word, Evidence]:
    """Operations of (3.7), of what it replaces, and of what it leaves to the law."""
    told, is_less, is_left = [], [], []
    for joints in INVERSES:
        rows = {one: controller_costs(results, one, joints) for one in (BY_EULER, BY_COMMON, ON_MATRIX)}
        total = {one: adequacy.tallied(own, with_goal=False) for one, own in rows.items()}
        law = {one: adequacy.of_stage(own, "regulate") for one, own in rows.items()}
        is_less += [by_columns(total[BY_EULER], total[one]) == ORDERED for one in (BY_COMMON, ON_MATRIX)]
        is_left.append(law[BY_EULER].flops <= LIMIT.MUCH * law[ON_MATRIX].flops)
        told.append(
            f"on {joints} joints (3.7) takes {total[BY_EULER]} flops and calls, (2.2) with (2.15) {total[BY_COMMON]}, "
            f"(2.2) with the law on R {total[ON_MATRIX]}; the law alone {law[BY_EULER].flops} flops against "
            f"{law[ON_MATRIX].flops} on R"
        )
    return word_of(all(is_less) and all(is_left), all(is_left)), evidence(
        f"Typical ticks: {'; '.join(told)}.", 3 * len(told)
    )

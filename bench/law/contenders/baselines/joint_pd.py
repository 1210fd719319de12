"""A spring and a damper at every joint, and gravity compensated: tau = M (Kp (q_d - q) - Kv qdot) + g(q).

M is constant: D's diagonal at the arm's home, so that the gains mean what they mean elsewhere as nearly as constants
can. It needs the goal's joint angles q_d, which are the start's (`goal_q`), gravity, and nothing else of the model: no
Jacobian, no coordinates, no inertia matrix. With V = (qdot' D qdot + Kp (q_d - q)' M (q_d - q))/2 it has
Vdot = -Kv qdot' M qdot, whatever the arm: it comes to rest at q_d from everywhere (Takegaki and Arimoto 1981).

Limitations: the tool goes where the joints take it, and its response depends on the pose.
"""

from bench.law import PUBLISHED, Baseline, Inverse, Jacobian, Law, kernel


@kernel
def assemble(chain, goal, p_d, gains, memory, J, a):
    """Compute a = Kp (q_d - q) - Kv qdot from a = q_d - q; u, for the record, is what the tool gets."""
    x = y = z = 0.0
    axes, qdot = chain.axes, chain.qdot
    for i in range(chain.n):
        a[i] = gains.kp * a[i] - gains.kv * qdot[i]
        x = x + axes[i, 0] * a[i]
        y = y + axes[i, 1] * a[i]
        z = z + axes[i, 2] * a[i]
    return (x, y, z), memory


@kernel
def resolve(J, a, D, x, rows, n, scratch):
    """x = M a, M on J's diagonal."""
    for i in range(n):
        x[i] = J[i, i] * a[i]


JOINTS = Jacobian("joints", "The joints themselves", "", r"\dot q", "joints", lambda representation: (None, None))
INERTIA = Inverse("inertia-at-home", "Inertia at home", "", r"\tau = M a", resolve, "joint-torque")

BASELINE = Baseline(
    Law(
        name="joint-pd",
        title="Joint PD with gravity compensation",
        source="Takegaki & Arimoto 1981; the scale M of the gains is ours",
        attribution=PUBLISHED,
        formula=r"\tau = M (K_p (q_d - q) - K_v \dot q) + g(q)",
        property="global in the joints",
    ),
    assemble=assemble,
    resolution=(JOINTS, INERTIA),
)

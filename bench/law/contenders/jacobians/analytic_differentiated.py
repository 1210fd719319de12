"""The Euler Jacobian by differentiating the coordinates of R element by element (Murphy 1988, 3.5).

Joint i turns R at [z_i]x R for each rad/s, so its column is dE/dR along that; Jdot_E qdot is the second derivative of E
along R's own motion at qddot = 0, Rdot = [omega]x R and Rddot = ([omegadot]x + [omega]x [omega]x) R. The same matrix
as `analytic` to rounding: what the literature before the paper did, and the price that the paper compares with.

Limitations: as `analytic` does.
"""

from bench.law import PUBLISHED, Jacobian, Rotation, cross, kernel
from bench.law.contenders.jacobians.geometric import fill as fill_geometric


@kernel
def turning(omega, R):
    """[omega]x R."""
    return Rotation(cross(omega, R.n), cross(omega, R.o), cross(omega, R.a))


@kernel
def bending(omegadot, omega, r, rdot):
    """[omegadot]x r + [omega]x rdot, of one column."""
    swung, pulled = cross(omegadot, r), cross(omega, rdot)
    return (swung[0] + pulled[0], swung[1] + pulled[1], swung[2] + pulled[2])


def kernels_in(representation):
    """fill and drift in the coordinates of one representation."""
    differentiate, differentiate_twice = representation.differentiate, representation.differentiate_twice
    count = len(representation.symbols)

    @kernel
    def fill(J, chain, at):
        """J_i = [z_i x (p - p_i); dE/dR along [z_i]x R]; `at` is not needed."""
        fill_geometric(J, chain)
        for i in range(chain.n):
            turned = differentiate(chain.R, turning((J[3, i], J[4, i], J[5, i]), chain.R))
            for k in range(count):
                J[3 + k, i] = turned[k]

    @kernel
    def drift(chain, at, Edot, omega, bias):
        """Jdot_E qdot = (pddot, Eddot along R's motion at qddot = 0); `at` and Edot are not needed."""
        R, omegadot = chain.R, (bias[3], bias[4], bias[5])
        Rdot = turning(omega, R)
        Rddot = Rotation(
            bending(omegadot, omega, R.n, Rdot.n),
            bending(omegadot, omega, R.o, Rdot.o),
            bending(omegadot, omega, R.a, Rdot.a),
        )
        # added, not spread with a star: compiled code has no (*a, *b) of tuples
        turned = differentiate_twice(R, Rdot, Rddot)
        return (bias[0], bias[1], bias[2]) + turned  # noqa: RUF005

    return fill, drift


JACOBIAN = Jacobian(
    name="analytic-differentiated",
    title="Analytic, differentiated",
    source="Murphy 1988, (3.5)",
    attribution=PUBLISHED,
    formula=r"(J_E)_i = \begin{pmatrix} z_i \times (p - p_i) \\ "
    r"\tfrac{\partial E}{\partial R}\, [z_i]_\times R \end{pmatrix}",
    takes="coordinates",
    kernels_in=kernels_in,
    needs_derivatives=True,
)

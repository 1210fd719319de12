"""When a peg that touches both sides of its hole slides in, and when it jams (Whitney 1982, the jamming diagram).

In a plane through the hole's axis the hand pushes the peg with a force (x across, z inwards) and a moment m about the
middle of its lower face, which is 2 r wide and has gone in by l. With lambda = l/(2 r mu) it slides if

    |x/z| <= 1/mu        and        |m/(r z) - mu (1 + lambda) x/z| <= lambda

m is positive where it turns the lower face's near side, in the direction of x, inwards. Outside it jams: no force along
these lines, however great, moves it.

Limitations: with lambda < 1 a peg may be wedged besides: both contacts' friction cones see each other, and it stays
whatever the load.
Source: Whitney 1982, "Quasi-static assembly of compliantly supported rigid parts", equations 16 to 20.
"""


def margin(across: float, turning: float, reach: float, mu: float) -> float:
    """Return the greater of |x/z| mu and |m/(r z) - mu (1 + lambda) x/z| / lambda: it slides up to 1.

    Args:
        across: x/z. turning: m/(r z). reach: lambda.
    """
    return max(abs(across) * mu, abs(turning - mu * (1.0 + reach) * across) / reach)

"""The cross product, and a damper of what moves the axis: the spin about it is not touched.

    u = Kp a x a_d - Kv (omega - (a . omega) a)

a . u = 0 and a' = omega x a, so that (a . omega)' = 0: a body that spins keeps its spin for ever, exactly. V =
Kp (1 - a . a_d) + |omega|^2/2 has V' = -Kv |omega - (a . omega) a|^2: almost global on S^2.

Fails: rests where the axis points exactly the opposite way.

Source: Bullo, Murray, Sarti 1995, Control on the sphere and reduced attitude stabilization (the damper acts on the
rate of the axis); Chaturvedi, Sanyal, McClamroch 2011, Rigid-body attitude control.
"""

from bench.law import SINE, Pointing, cross, dot, kernel, spring_damper


@kernel
def law(a, omega, a_d, gains):
    """u = Kp a x a_d - Kv (omega - (a . omega) a); all in the base frame."""
    spin = dot(a, omega)
    across = (omega[0] - spin * a[0], omega[1] - spin * a[1], omega[2] - spin * a[2])
    return spring_damper(gains.kp, cross(a, a_d), gains.kv, across)


POINTING = Pointing(
    name="free-spin",
    title="Cross product, spin left alone",
    source="Bullo, Murray & Sarti 1995; Chaturvedi, Sanyal & McClamroch 2011",
    formula=r"u = K_p\,a \times a_d - K_v\,\bigl(\omega - (a \cdot \omega)\,a\bigr)",
    law=law,
    spring=SINE.spring,
    keeps_spin=True,
    property="almost global",
)

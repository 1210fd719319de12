"""The cross product of where the axis points and where it shall, and a damper of all rates.

    u = Kp a x a_d - Kv omega

a x a_d = sin(theta) k turns a to a_d along the great circle. V = Kp (1 - a . a_d) + |omega|^2/2 has V' = -Kv |omega|^2:
almost global on S^2.

Fails: rests where the axis points exactly the opposite way.

Source: Bullo, Murray, Sarti 1995, Control on the sphere and reduced attitude stabilization; Chaturvedi, Sanyal,
McClamroch 2011, Rigid-body attitude control.
"""

from bench.law import SINE, Pointing, cross, kernel, spring_damper


@kernel
def law(a, omega, a_d, gains):
    """u = Kp a x a_d - Kv omega; all in the base frame."""
    return spring_damper(gains.kp, cross(a, a_d), gains.kv, omega)


POINTING = Pointing(
    name="cross-product",
    title="Cross product, all rates damped",
    source="Bullo, Murray & Sarti 1995; Chaturvedi, Sanyal & McClamroch 2011",
    formula=r"u = K_p\,a \times a_d - K_v\,\omega",
    law=law,
    spring=SINE.spring,
    keeps_spin=False,
    property="almost global",
)

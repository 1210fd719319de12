"""Values of the motions of the law `sliding`."""

LAW, WITH_MEMORY = "sliding", "sliding-memory"
STARTS_OF_A_SET = 100

PERIODS_S = (1e-3, 1e-4, 1e-5)
NOISE_SHARE = 3.0
"""Control periods, and the noise over Kp period^2. From rest the command 2 Kp turns the body by 1 in this unit in
one period, so that less cannot turn it back in time; at 3 it can."""

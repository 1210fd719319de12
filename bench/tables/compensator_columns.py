"""compensators.parquet: laws with a state of their own, under a constant disturbance."""

from bench.tables.column import COUNT, Column, numbers, words


def compensator_columns() -> list[Column]:
    """compensators.parquet: laws with a state of their own (bench/contenders/compensators), by disturbance.

    Beside them the paper's law on R, whose spring they have. The free body starts at rest all over SO(3).
    """
    return [
        *words(law="the law", reads_rate="whether it reads the angular velocity: yes or no"),
        *numbers("rad/s^2", "constant disturbance of the angular acceleration, base frame", "disturbance"),
        *numbers("1/s^2", "position gain", "kp"),
        *numbers("1/s", "velocity gain", "kv"),
        *numbers("s", "control period and integration step", "dt_s"),
        *numbers("s", "time simulated", "horizon_s"),
        Column("starts", COUNT, "1", "episodes"),
        Column("settled", COUNT, "1", "of them, those within 1° at the end"),
        *numbers("s", "median of their times after which the angle stays within 1°; null of none", "settling_median_s"),
        *numbers("s", "greatest of them", "settling_worst_s"),
        *numbers("rad", "greatest angle at the end", "left_rad"),
        *numbers("rad/s^2", "greatest command", "peak_u"),
    ]

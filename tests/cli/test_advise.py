"""What `advise` says: limits where no law is stable, what is wrong with a bound, ties and exclusions, and prices."""

import re

import pytest
from support.command_line import bench

UNSTABLE = ("--kp", "100", "--kv", "38", "--delay", "24.3ms", "--rate", "20.576", "--inertia", "0.672")
UNSTABLE = (*UNSTABLE, "--unevenness", "0.482")


def advise(capsys, *words):
    """Return what the command says, in one line."""
    said = bench(capsys, "advise", *words)
    assert said.code == 0
    return " ".join(said.out.split())


def test_loop_that_is_unstable_for_every_law_gets_no_law_and_its_limits(capsys):
    said = advise(capsys, *UNSTABLE)
    assert said.startswith("Which law No law: the linear loop near the goal")
    kv = float(re.search(r"reduce kv below ([\d.]+) 1/s", said, re.IGNORECASE)[1])
    assert 0.0 < kv < 38.0
    assert "settle in" not in said


def test_limits_of_delay_and_gain_are_those_that_make_the_loop_stable(capsys):
    words = ("--kp", "200", "--kv", "28", "--rate", "20")
    said = advise(capsys, *words, "--delay", "60ms")
    delay = float(re.search(r"delay below ([\d.]+) ms", said)[1])
    assert "spectral radius" in said
    assert "spectral radius" in advise(capsys, *words, "--delay", f"{1.05 * delay}ms")
    assert "is unstable" not in advise(capsys, *words, "--delay", f"{0.9 * delay}ms")
    assert "Outside the map: delay 0.849/√kp" in said


def test_damping_outside_the_map_borrows_no_time(capsys):
    said = advise(capsys, "--kp", "100", "--kv", "0.5")
    assert "damping ratio 0.025, the map has 0.5 to 2" in said
    slow, envelope = map(float, re.search(r"needs ([\d.]+) s to 2 % .*\(([\d.]+) s without", said).groups())
    assert envelope == pytest.approx(15.6, abs=0.1)  # ln 50 / (kv/2)
    assert envelope < slow < 1.2 * envelope
    assert "It is in the map" not in said


def test_bound_far_below_the_map_has_a_least_time(capsys):
    said = advise(capsys, "--bound", "0.1")
    assert "No law: with this bound no law can settle 99 % of the starts in less than 9.71 s" in said


def test_weak_motor_is_answered_by_a_law_close_to_the_fastest_motions(capsys):
    words = ("--kp", "400", "--kv", "28", "--bound", "30", "--delay", "5ms", "--rate", "500", "--robot", "torque")
    said = advise(capsys, *words)
    law, seconds = re.search(r"^Which law Use (\S+) \(adapted\): 99 % of the starts settle in (\S+) s", said).groups()
    fastest, ratio = re.search(rf"99 % of the starts in (\S+) s; {law} takes (\S+) times as long", said).groups()
    overshoot = re.search(rf"{law}: greatest command 30 rad/s², overshoot (\S+)°", said)[1]
    assert float(ratio) == pytest.approx(float(seconds) / float(fastest), abs=0.01)
    assert float(ratio) < 1.15
    assert float(overshoot) < 5.0


def test_ties_price_and_runner_up_stand_with_the_law(capsys):
    said = advise(capsys)
    answer, _, rest = said.partition("Price ")
    assert "Use mrp-memory (adapted): 99 % of the starts settle in 0.58" in answer
    assert "within 5%" in answer
    # 4 kp at a rotation by nearly 180°
    assert re.search(r"greatest command (399|400)(\.\d)? rad/s², overshoot 0\.0°, keeps 4 numbers", rest)
    assert ", the next: " in rest
    assert "no law at all can be faster" not in rest
    assert "It is in the map." in rest or "The nearest of the map" in rest

"""What `advise` says of an arm, in N m/rad, and which options it refuses with which reason."""

import re

import pytest
from support.command_line import bench, refused
from support.gimbal import MJCF, URDF

import tasks

PARTS = ("Arm ", "Inertia ", "Damping ", "Stable ", "Bound ", "Law ", "How sure ")
MOST_LINES = 25
TOO_STIFF = ("--stiffness", "50000", "--delay", "5ms")
"""No law is simulated: the loop is unstable at both ends."""


@pytest.fixture
def gimbal(tmp_path):
    """An arm that is not in the repository."""
    path = tmp_path / "gimbal.xml"
    path.write_text(MJCF, encoding="utf-8")
    return path


def advise(capsys, *words):
    """Return what the command says, in one line."""
    said = bench(capsys, "advise", *words)
    assert said.code == 0, said.err
    assert len(said.out.splitlines()) <= MOST_LINES
    return " ".join(said.out.split())


@pytest.mark.parametrize("name", tasks.arm_names())
def test_spring_that_is_too_stiff_for_the_delay_gets_no_law_on_any_arm(capsys, name):
    said = advise(capsys, "--arm", name, *TOO_STIFF)
    places = [said.index(part) for part in PARTS]
    assert places == sorted(places)
    assert said.startswith(
        f"Arm {tasks.arm(name).title}, {tasks.arm(name).joints} joints to site tool"
    )
    assert "no D makes this K stable in the lightest pose" in said
    assert "No law, at either end." in said
    assert f"{min(tasks.arm(name).rated):g} N m over K" in said


@pytest.mark.slow
def test_arm_that_is_not_in_the_repository_is_answered_in_full(capsys, gimbal):
    said = advise(
        capsys,
        "--mjcf",
        gimbal,
        "--site",
        "grip",
        "--stiffness",
        "50",
        "--damping",
        "2",
        "--torque",
        "25",
    )
    assert "gimbal.xml, 3 joints to site grip" in said
    # A ball of 0.02 kg m^2: K/J, 2 sqrt(K J), K T/2, 2 J/T, 2 D/T and torque/K.
    assert "0.02 to 0.02 kg m² with the position free" in said
    assert "So kp = K/inertia is 2,500 to 2,500 1/s²" in said
    assert "2 to 2 N m s/rad, ratio 1." in said
    assert "D from 0.025 to 40 N m s/rad at your K" in said
    assert "K below 4,000 with D = 2" in said
    assert "is 0.5 rad (28.6°)" in said
    law = re.search(r"Use ([a-z-]+) at any inertia", said)[1]
    assert re.search(
        rf"kp 2,500 1/s², ratio 1\): {law} \((published|adapted)\) settles 99 % in 0\.\d+ s", said
    )
    # The same question as of a body.
    [command] = re.findall(r"bench (advise --kp 2500 --kv 100 --rate 1000 --bound 1250 .*)$", said)
    assert f"Use {law} " in " ".join(bench(capsys, *command.split()).out.split())


def test_file_says_what_the_answer_lacks(capsys, gimbal):
    bare = advise(capsys, "--mjcf", gimbal, "--site", "grip", *TOO_STIFF)
    assert "no motor inertia (armature)" in bare
    assert "friction and filters are left out" in bare
    gimbal.write_text(
        MJCF.replace("<compiler", '<default><joint armature=".1" damping="1"/></default><compiler')
    )
    full = advise(capsys, "--mjcf", gimbal, "--site", "grip", *TOO_STIFF)
    assert "armature" not in full
    assert "the file's joint damping and filters are left out" in full


def test_urdf_is_answered_and_says_which_body_it_took(capsys, tmp_path):
    path = tmp_path / "gimbal.urdf"
    path.write_text(URDF, encoding="utf-8")
    assert "gimbal.urdf, 3 joints to body grip" in advise(capsys, "--urdf", path, *TOO_STIFF)


def test_damping_that_is_unstable_is_said_first(capsys):
    said = advise(capsys, "--arm", "panda", "--stiffness", "50", "--damping", "1000")
    assert "Stable Your K and D are unstable in the lightest poses." in said
    assert "Low, " in said
    assert "no law, because the loop is unstable (see Stable)" in said


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (
            "--arm pando --stiffness 50",
            f"arm 'pando' is not in tasks/arms; known: {', '.join(tasks.arm_names())}",
        ),
        (
            "--arm panda",
            "--arm needs the stiffness of its orientation spring (try: --stiffness 50)",
        ),
        ("--stiffness 50", "name the arm, too (try: --arm panda --stiffness 50)"),
        ("--torque 12 --kp 400", "--torque is a number or name of an arm"),
        ("--arm panda --mjcf a.xml --stiffness 50", "--arm and --mjcf both name an arm"),
        (
            "--arm panda --stiffness 50 --kp 400",
            "--kp is the stiffness over the inertia felt, which is computed",
        ),
        ("--arm panda --stiffness 50 --bound 30", "which is computed; give --torque"),
        ("--arm panda --stiffness 50 --robot velocity", "an orientation spring commands torque"),
        ("--arm panda --stiffness 50 --site tool", "the tool of --arm is its site 'tool'"),
        ("--urdf a.urdf --stiffness 50 --site tool", "a URDF has no sites"),
        ("--mjcf a.xml --stiffness 50 --site a --body b", "--site and --body both name the tool"),
        ("--mjcf nowhere.xml --site tool --stiffness 50", "'nowhere.xml' is no file"),
        ("--arm panda --stiffness 50 --damping 0", "nothing settles without damping"),
        (
            "--arm panda --stiffness -5",
            "--stiffness '-5': give a number from 0.001 to 1e+06 (try: --stiffness 50)",
        ),
    ],
)
def test_options_that_do_not_go_together_are_refused_with_the_reason(capsys, words, reason):
    line = refused(capsys, "advise", *words.split())
    assert reason in line
    assert "try: " in line or "(use one" in line or "(give " in line


def test_file_without_a_site_named_lists_its_sites(capsys, gimbal):
    line = refused(capsys, "advise", "--mjcf", gimbal, "--stiffness", "50")
    assert "which site is the end effector? its sites: grip" in line

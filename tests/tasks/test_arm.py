"""Arms are found at the time of the call, by what is in their files; a broken one is refused with the cure."""

import re
import tomllib
from pathlib import Path

import mujoco
import numpy as np
import pytest
from support.own_arm import JOINTS, xml

from tasks.arm import arm, arm_names, arms
from tasks.arm_model import model_xml
from tasks.errors import BadArm, UnknownName

PYTHON_ARM = '''
from pathlib import Path

def xml() -> str:
    return """{}"""
'''
WRITTEN = {"xml": "{}", "py": PYTHON_ARM}


@pytest.fixture
def own(tmp_path):
    """own(line, instead) -> the small arm of which one line is replaced, from a file of this suffix."""

    def made(line="", instead="", suffix="xml"):
        text = xml().replace(line, instead, 1) if line else xml()
        (tmp_path / f"own.{suffix}").write_text(WRITTEN[suffix].format(text))
        return arm("own", tmp_path)

    return made


def test_names_are_file_names_with_dashes(tmp_path):
    (tmp_path / "my_arm.xml").write_text(xml())
    (tmp_path / "__init__.py").write_text("")
    (tmp_path / "notes.txt").write_text("")
    assert arm_names(tmp_path) == ["my-arm"]
    assert arm("my-arm", tmp_path).name == "my-arm"


@pytest.mark.parametrize("suffix", WRITTEN)
def test_text_is_kept_as_the_file_has_or_writes_it_until_it_is_edited(own, suffix):
    """Also within the second that a file's time is kept to, and at the same length."""
    assert own(suffix=suffix).xml == xml()
    assert own(suffix=suffix) is own(suffix=suffix)  # checked once
    for title in ("A small arm", "A smell arm", "A small arm"):
        assert own("A small arm", title, suffix).title == title


def test_file_that_is_gone_is_gone(own, tmp_path):
    own()
    (tmp_path / "own.xml").unlink()
    with pytest.raises(UnknownName):
        arm("own", tmp_path)


def test_every_keyframe_is_a_pose(own):
    found = own("</keyframe>", '<key name="up" qpos="0 0 0 0 0 1"/></keyframe>')
    assert found.pose("home") == found.home
    assert found.pose("up") == (0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    with pytest.raises(UnknownName, match=r"no keyframe 'down'; known: home, up \(use one"):
        found.pose("down")


def test_joint_without_a_range_turns_for_ever(own):
    found = own('axis="0 0 1" range="-3 3"', 'axis="0 0 1"')
    assert np.isinf([found.lower, found.upper]).sum() == 2
    assert np.nanmin(found.upper) == 3.0


def test_model_overrides_the_options_of_the_file(own):
    option = '<option timestep=".004" gravity="0 0 -1"><flag gravity="disable" contact="enable"/></option>'
    dt = 1.0 / 3000.0  # carried to the last digit
    model = mujoco.MjModel.from_xml_string(model_xml(own('<option timestep=".004"/>', option), dt))
    disabled = mujoco.mjtDisableBit
    assert model.opt.timestep == dt
    assert model.opt.gravity.tolist() == [0.0, 0.0, -9.81]
    assert model.opt.disableflags == (disabled.mjDSBL_CONTACT | disabled.mjDSBL_LIMIT | disabled.mjDSBL_AUTORESET)


SEVENTH, EIGHTH = ("7", "0 1 0"), ("8", "0 0 1")
WITHOUT_TOOL = xml().replace('<site name="tool" pos="0 0 .2"/>', "")
NUMERIC = xml().replace("<custom>", '<custom><numeric name="{}" data="{}"/>')
AFTER = ("<worldbody>", '<joint name="joint 5" axis="0 1 0" range="-3 3"/>')
"""On the ground, or on the last link but one."""

BROKEN = {
    "5 joints": (
        "xml",
        xml(JOINTS[:5]),
        r"5 joints, not 6 or 7 \(fewer than 6 cannot hold a position and turn freely\)",
    ),
    "8 joints": ("xml", xml((*JOINTS, SEVENTH, EIGHTH)), r"8 joints, not 6 or 7 \(at most 7 are handled\)"),
    **{
        f"tool after {after}": (
            *("xml", WITHOUT_TOOL.replace(after, f'{after}<site name="tool"/>')),
            r'"tool" does not move with the last joint \(move it to the last body\)',
        )
        for after in AFTER
    },
    "hand": ("xml", NUMERIC.format("hand", "1 1 1 1 1 1 1"), "massless"),
    "motors": ("xml", NUMERIC.format("motors", "3 1 2"), "ascending"),
    "no text": ("xml", b"\xff\xfe\x00", r"own\.xml cannot be read"),
    "no Python": ("py", "def xml(: pass", r"xml\(\) of own\.py does not work \(SyntaxError"),
    "no module": ("py", "import no_such_module", r"own\.py does not work \(ModuleNotFoundError: .*no_such_module"),
    "no function": ("py", "TITLE = 'no function'", r"xml\(\) of own\.py does not work \(AttributeError"),
    "exit": ("py", "def xml(): raise SystemExit('stop')", r"xml\(\) of own\.py does not work \(SystemExit: stop"),
    "number": ("py", "def xml(): return 7", r"xml\(\) of own\.py returns int \(return the MJCF text, a str\)"),
    "cut off": ("py", "def xml(): return '<mujoco>'", "it is not XML"),
}
for word, fault in tomllib.loads(Path(__file__).with_name("broken_arms.toml").read_text(encoding="utf-8")).items():
    assert xml().count(fault["line"]) == 1
    BROKEN[word] = ("xml", xml().replace(fault["line"], fault["instead"]), fault["says"])


def refusal(folder, name: str = "own") -> str:
    with pytest.raises(BadArm) as caught:
        arm(name, folder)
    return str(caught.value)


@pytest.mark.parametrize("wrong", BROKEN)
def test_broken_arm_is_refused_with_the_cure(wrong, tmp_path):
    suffix, text, says = BROKEN[wrong]
    (tmp_path / f"own.{suffix}").write_bytes(text if isinstance(text, bytes) else text.encode())
    message = refusal(tmp_path)
    assert re.match(r"arm 'own': .*\)$", message)
    assert re.search(says, message)


@pytest.mark.parametrize(
    "text",
    [
        xml(),
        xml((*JOINTS, SEVENTH)),
        xml().replace('range="-3 3"', 'range="-3 3" damping="1" stiffness="2"'),  # in qfrc_passive: compensated
        xml().replace('qpos="0 .5 1', 'qpos="0 .5 3'),  # at a limit, where MuJoCo would push back
    ],
)
def test_arm_that_is_right_is_taken(text, tmp_path):
    (tmp_path / "own.xml").write_text(text)
    found = arm("own", tmp_path)
    assert found.joints == text.count("<joint name")
    assert found.home[:2] == (0.0, 0.5)


@pytest.mark.parametrize("name", ["Own", "own arm", "7dof", "own--arm"])
def test_file_whose_name_is_no_word_is_refused(name, tmp_path):
    (tmp_path / f"{name}.xml").write_text(xml())
    assert arm_names(tmp_path) == [name]
    assert "no word of a-z, 0-9 and _ (rename it" in refusal(tmp_path, name)


def test_two_files_of_one_arm_are_refused(tmp_path):
    (tmp_path / "own.xml").write_text(xml())
    (tmp_path / "own.py").write_text("def xml(): return ''")
    assert "own.py and own.xml (keep one)" in refusal(tmp_path)


def test_broken_arm_leaves_the_others_usable(tmp_path):
    (tmp_path / "broken.xml").write_text("<mujoco")
    (tmp_path / "own.xml").write_text(xml())
    assert arm_names(tmp_path) == ["broken", "own"]
    assert arm("own", tmp_path).title == "A small arm"
    found = arms(tmp_path)
    assert list(found) == ["broken", "own"]
    assert isinstance(found["broken"], BadArm)
    assert found["own"] == arm("own", tmp_path)

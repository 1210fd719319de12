"""Arms are found at the time of the call, by what is in their files; the judge's model of one."""

import mujoco
import numpy as np
import pytest
from support.own_arm import xml

from tasks.arm import arm, arm_names
from tasks.arm_model import model_xml
from tasks.errors import UnknownName

PYTHON_ARM = '''
from pathlib import Path

def xml() -> str:
    return """{}"""
'''
WRITTEN = {"xml": "{}", "py": PYTHON_ARM}
EITHER = pytest.mark.parametrize("suffix", WRITTEN)


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


@EITHER
def test_text_is_kept_as_the_file_has_or_writes_it(own, suffix):
    assert own(suffix=suffix).xml == xml()
    assert own(suffix=suffix) is own(suffix=suffix)  # checked once


@EITHER
def test_edited_file_is_another_arm_at_once(own, suffix):
    """Also within the second that a file's time is kept to, and at the same length."""
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

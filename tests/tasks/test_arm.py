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


def test_names_are_file_names_with_dashes(tmp_path):
    (tmp_path / "my_arm.xml").write_text(xml())
    (tmp_path / "__init__.py").write_text("")
    (tmp_path / "notes.txt").write_text("")
    assert arm_names(tmp_path) == ["my-arm"]
    assert arm("my-arm", tmp_path).name == "my-arm"


@pytest.mark.parametrize(("suffix", "text"), [("xml", xml()), ("py", PYTHON_ARM.format(xml()))])
def test_text_is_kept_as_the_file_has_or_writes_it(tmp_path, suffix, text):
    (tmp_path / f"own.{suffix}").write_text(text)
    assert arm("own", tmp_path).xml == xml()


@pytest.mark.parametrize("suffix", ["xml", "py"])
def test_edited_file_is_another_arm_at_once(suffix, tmp_path):
    """Also within the second that a file's time is kept to, and at the same length."""
    path = tmp_path / f"own.{suffix}"
    for title in ("A small arm", "A smell arm", "A small arm"):
        text = xml().replace("A small arm", title)
        path.write_text(PYTHON_ARM.format(text) if suffix == "py" else text)
        assert arm("own", tmp_path).title == title


def test_same_text_is_checked_once(tmp_path):
    (tmp_path / "own.xml").write_text(xml())
    assert arm("own", tmp_path) is arm("own", tmp_path)


def test_file_that_is_gone_is_gone(tmp_path):
    path = tmp_path / "own.xml"
    path.write_text(xml())
    arm("own", tmp_path)
    path.unlink()
    with pytest.raises(UnknownName):
        arm("own", tmp_path)


def test_every_keyframe_is_a_pose(tmp_path):
    (tmp_path / "own.xml").write_text(xml().replace("</keyframe>", '<key name="up" qpos="0 0 0 0 0 1"/></keyframe>'))
    own = arm("own", tmp_path)
    assert own.pose("home") == own.home
    assert own.pose("up") == (0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    with pytest.raises(UnknownName, match=r"no keyframe 'down'; known: home, up \(use one"):
        own.pose("down")


def test_joint_without_a_range_turns_for_ever(tmp_path):
    (tmp_path / "own.xml").write_text(xml().replace('axis="0 0 1" range="-3 3"', 'axis="0 0 1"', 1))
    own = arm("own", tmp_path)
    assert np.isinf([own.lower, own.upper]).sum() == 2
    assert np.nanmin(own.upper) == 3.0


def test_model_overrides_the_options_of_the_file(tmp_path):
    option = '<option timestep=".004" gravity="0 0 -1"><flag gravity="disable" contact="enable"/></option>'
    (tmp_path / "own.xml").write_text(xml().replace('<option timestep=".004"/>', option))
    model = mujoco.MjModel.from_xml_string(model_xml(arm("own", tmp_path), 0.002))
    disabled = mujoco.mjtDisableBit
    assert model.opt.timestep == 0.002
    assert model.opt.gravity.tolist() == [0.0, 0.0, -9.81]
    assert model.opt.disableflags == (disabled.mjDSBL_CONTACT | disabled.mjDSBL_LIMIT | disabled.mjDSBL_AUTORESET)


def test_integration_step_is_carried_to_the_last_digit(tmp_path):
    (tmp_path / "own.xml").write_text(xml())
    dt = 1.0 / 3000.0
    assert mujoco.MjModel.from_xml_string(model_xml(arm("own", tmp_path), dt)).opt.timestep == dt

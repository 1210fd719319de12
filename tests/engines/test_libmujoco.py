"""Models as compiled loops step them: without what cameras alone see, and without a clock.

That no bit of an episode is another one for it is held where engines are compared: dm_control steps whole models.
"""

import mujoco
import pytest

import tasks
from bench.engines.native.libmujoco import model_of
from tasks.contact_model import model_xml


@pytest.mark.parametrize("arm", tasks.arm_names())
def test_has_no_geom_that_cannot_touch(arm):
    assert mujoco.MjModel.from_xml_string(tasks.task("arm-regulation", arm).xml(1e-3)).ngeom > 0
    assert model_of(tasks.task("arm-regulation", arm).xml(1e-3), "euler").ngeom == 0


@pytest.mark.parametrize("name", tasks.contact_names())
def test_keeps_every_geom_that_can_touch(name):
    xml = model_xml(tasks.contact_task(name), tasks.arm("ur5e"), 1e-3)
    whole, lean = mujoco.MjModel.from_xml_string(xml), model_of(xml, "implicitfast")
    touching, kept = (
        sorted(one.geom(i).size.tolist() for i in (*one.pair_geom1, *one.pair_geom2)) for one in (whole, lean)
    )
    assert kept == touching
    assert lean.ngeom < whole.ngeom


def test_clock_is_not_asked():
    model = model_of(tasks.task("free-body").xml(1e-3), "euler")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    assert [one.duration for one in data.timer] == [0.0] * len(data.timer)

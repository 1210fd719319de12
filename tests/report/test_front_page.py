"""The front page: its code is the advised law, it names what leads to another, and a shared link has a picture."""

import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.states import as_rotation, vector

from bench.findings.selection.regions import find_default
from bench.findings.selection.robots import ROBOTS, list_elsewhere
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains, Goal
from report.figures import index
from report.figures.kit.page import REPORT, text_of

[CODE] = re.findall(r"```python\n(.*?)```", text_of("index"), re.DOTALL)


def test_code_to_paste_is_the_advised_law_over_random_states():
    shown = {}
    exec(re.sub("^   ", "", CODE, flags=re.MULTILINE), shown)
    generator, law = np.random.default_rng(7), find_contender(find_default()).regulator
    for _ in range(50):
        rotations = Rotation.random(40, rng=generator)
        goal, memory, q_old = rotations[0].as_matrix(), law.memory, np.array([0.0, 0.0, 0.0, 1.0])
        for R in rotations.as_matrix():
            omega, (kp, kv) = generator.normal(size=3) * 9.0, generator.uniform(1.0, 200.0, 2)
            wanted, memory = law.law(as_rotation(R.T), vector(omega), Goal(as_rotation(goal.T)), Gains(kp, kv), memory)
            found, q_old = shown["command"](R, goal, omega, q_old, kp, kv)
            np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-7)


def test_front_page_names_every_need_with_its_law():
    found, said = list_elsewhere(), index.list_needs()
    assert {robot.takes in " ".join(one.words for one in found) for robot in ROBOTS.values()} == {True}
    for one in found:
        named = re.findall(r"laws/([\w-]+)\.html", said.partition(one.words)[0]) if one.words in said else [""]
        assert named[-1] == (one.law if one.law != find_default() else "")


@pytest.mark.skipif(not (REPORT / "_build/html/index.html").is_file(), reason="the report is not built")
@pytest.mark.parametrize(("page", "up"), [("index", ""), ("pages/07-which-error", "../"), ("laws/mrp", "../")])
def test_shared_link_has_a_description_and_a_picture(page, up):
    text = (REPORT / f"_build/html/{page}.html").read_text(encoding="utf-8")
    tags = dict(re.findall(r'<meta (?:name|property)="(description|og:\w+)" content="([^"]*)">', text))
    assert tags["og:image"] == f"{up}_static/media/fates.png"
    assert tags["og:description"] == tags["description"]
    assert 20 <= len(tags["description"]) <= 202
    assert tags["og:title"]

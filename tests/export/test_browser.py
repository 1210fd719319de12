"""The script of the live page in node: its episodes are those of the compiled loops, also under perturbations."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from support import live
from support.exported import NODE, needs

import tasks
from bench.base.provenance import ROOT
from bench.export import browser
from bench.law.contenders.registry import all_contenders
from tasks.condition import Condition

PERTURBED = {
    "late": Condition(delay_s=0.03),
    "slow": Condition(period_s=0.02, delay_s=0.007),
    "weak": Condition(bound=30.0),
    "wrong-at-180": Condition(worst_attitude_error=0.1),
    "uneven": Condition(inertia=(0.5, 1.0, 2.0), period_s=0.005),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("live")
    (made / "laws.js").write_text(browser.script(all_contenders()))
    shutil.copy(ROOT / "report" / "_extra" / "live-episode.js", made)
    (made / "play.js").write_text(
        "require('./laws.js'); require('./live-episode.js');\n"
        f"const played = {live.PLAYED};\n"
        "const given = JSON.parse(require('fs').readFileSync(0, 'utf8'));\n"
        "console.log(JSON.stringify(given.words.map(word => played(word, ...given.others))));\n"
    )
    return made


@pytest.fixture(scope="module")
def starts():
    return [*tasks.start_set("uniform", 40), *tasks.start_set("tumbling", 20), *tasks.start_set("half-turn")[::20]]


def played(folder, words, starts, condition=live.IDEAL):
    """Rows of each law."""
    given = {"words": words, "others": [live.rows_of(starts), *live.asked(condition), live.SEEN]}
    ended = subprocess.run(
        ["node", "play.js"], cwd=folder, env={"PATH": NODE}, input=json.dumps(given), capture_output=True, text=True
    )
    assert ended.stderr == ""
    return dict(zip(words, json.loads(ended.stdout), strict=True))


def beyond(wanted, found):
    """Laws with more episodes that differ than rounding explains, and which."""
    which = {word: live.differing(one, found[word]) for word, one in wanted.items()}
    return {word: some for word, some in which.items() if len(some) > live.most_that_rounding_decides(wanted[word])}


@needs("node")
def test_every_law_does_what_the_sampled_plant_has_recorded(folder, starts):
    words = [one.on_free_body for one in all_contenders()]
    found = played(folder, words, starts)
    wanted = {word: live.by_the_sampled_plant(word, starts) for word in words}
    assert beyond(wanted, found) == {}
    assert sum(one.is_algebraic for one in wanted.values()) >= 12


@needs("node")
@pytest.mark.parametrize("name", PERTURBED)
def test_perturbed_episodes_end_as_the_compiled_loop_ends_them(folder, starts, name):
    words = ["rotation-matrix", "late-braking", "quaternion-shortest", "boskovic", "feedback-linearized/zyx-euler"]
    found = played(folder, words, starts, PERTURBED[name])
    wanted = {word: live.by_the_perturbed_plant(word, starts, PERTURBED[name]) for word in words}
    assert beyond(wanted, found) == {}
    assert len({row[0] for rows in found.values() for row in rows}) > 1


@needs("node")
def test_what_a_reader_copies_of_a_law_runs_alone(folder):
    """The functions that the page names, and nothing else, make the law's command."""
    shutil.copy(Path(__file__).with_name("copied.js"), folder)
    ended = subprocess.run(["node", "copied.js"], cwd=folder, env={"PATH": NODE}, capture_output=True, text=True)
    assert (ended.stderr, json.loads(ended.stdout)) == ("", [len(all_contenders()), []])


def test_functions_are_there_once():
    heads = [line for line in browser.script(all_contenders()).splitlines() if line.startswith("function ")]
    assert len(heads) == len({line.partition("(")[0] for line in heads})

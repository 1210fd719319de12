"""Published, adapted, ours: whose every contender is, and what its source then says."""

import re

import pytest
from support.user_law import law_text

from bench.base.errors import BadLaw
from bench.law.attribution import ADAPTED, AFTER, OURS, PUBLISHED, SHIPPED_ATTRIBUTIONS, THIS_BENCHMARK, YOURS
from bench.law.contenders import registry
from bench.law.contenders.described_law import described
from bench.law.contenders.law_file import load_law
from bench.law.contenders.regulators import gibbs
from bench.law.control.unshaped import DAMPINGS

EVERY = [
    pytest.param(one, id=f"{kind}-{one.name}")
    for kind in registry.FOLDERS
    for one in registry.contenders(kind).values()
]
EVERY += [pytest.param(one, id=f"dampings-{one.name}") for one in DAMPINGS.values()]
on_every = pytest.mark.parametrize("one", EVERY)
on_published = pytest.mark.parametrize("one", [each for each in EVERY if each.values[0].attribution == PUBLISHED])

NOT_THE_WORK = ("also ", "equal to ", "parameters: ", "unwinding: ")
"""How a part of a published law's source begins that names a second work."""
CONSTANT_IS_OURS = re.compile(r"(is|are) ours$")


@on_every
def test_source_begins_as_the_attribution_says(one):
    assert one.attribution in SHIPPED_ATTRIBUTIONS
    assert one.source.startswith(AFTER) == (one.attribution == ADAPTED)
    assert one.source.startswith(THIS_BENCHMARK) == (one.attribution == OURS)


@on_published
def test_published_contender_names_one_work_first_and_what_is_ours_after_it(one):
    work, *others = one.source.split("; ")
    assert len(re.findall(r"\b(?:1[89]|20)\d\d\b", work.partition("@")[0])) <= 1
    assert [
        part for part in others if not (part.startswith(NOT_THE_WORK) or CONSTANT_IS_OURS.search(part))
    ] == []


def test_law_of_a_user_is_yours_whatever_its_file_says(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(law_text("return omega").replace('"u", law)', '"u", law, attribution="published")'))
    assert 'attribution="published"' in path.read_text()
    assert load_law(path).attribution == YOURS
    assert described(path).attribution == YOURS
    assert not load_law(path).is_ours()


def test_file_here_that_says_no_word_is_refused(monkeypatch):
    """Take a law that somebody copies into regulators/ without a word on whose it is."""
    monkeypatch.setattr(gibbs, "REGULATOR", gibbs.REGULATOR._replace(attribution=YOURS))
    with pytest.raises(BadLaw, match="attribution is 'yours'; a file of this repository says published, adapted"):
        registry.contenders.__wrapped__("regulators")

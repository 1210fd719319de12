"""No sentence, card or heading calls a law published that is adapted, or ours."""

import re

import pytest

from bench.cli.summary import answer
from bench.export.heading import heading
from bench.export.subject import find_subject
from bench.findings.amounts import join_words
from bench.findings.selection.regions import find_regions
from bench.law.attribution import ADAPTED, AFTER, IN_WORDS, OURS, PUBLISHED, YOURS, describe_source
from bench.law.contenders.registry import all_contenders, contenders, find_contender
from report.figures.answer import which_law
from report.figures.cards import card, regulators
from report.figures.kit import families
from report.figures.method import method

CALLED_PUBLISHED = re.compile(r"\bpublished\b(?! (?:or|and) adapted\b)(?! parts\b)", re.IGNORECASE)
"""The word for one law; "published or adapted laws" are a set, and an adapted law has published parts."""
NOT_PUBLISHED = [one for one in all_contenders() if one.attribution != PUBLISHED and not one.regulator.in_engine]


def texts():
    """What the book and the terminal say of the advised law and the others."""
    yield which_law.lead()
    yield which_law.describe_default()
    yield which_law.describe_ours()
    for paragraph in answer.paragraphs(None):
        yield from paragraph.sentences
    for region in find_regions():
        yield regulators.advised(region.law)


def test_sentences_call_no_law_published_that_is_not():
    for text in texts():
        for sentence in re.split(r"(?<=[.;]) ", text):
            named = [one for one in NOT_PUBLISHED if one.name in sentence or families.word(one.name) in sentence]
            assert not (named and CALLED_PUBLISHED.search(sentence)), sentence


def test_advised_law_is_called_what_it_is():
    law = find_regions()[0].law
    words = IN_WORDS[find_contender(law).attribution]
    assert f"Use **{families.word(law)}**, {words}." in which_law.lead()
    source = describe_source(find_contender(law).attribution, find_contender(law).regulator.source)
    assert f"Use the law {law} ({source.partition('; ')[0]})" in answer.paragraphs(None)[0].sentences[0]


@pytest.mark.parametrize("one", NOT_PUBLISHED, ids=lambda one: one.name)
def test_heading_of_an_exported_law_says_whose_it_is(one):
    lines = " ".join(heading(find_subject(one.name)).split())
    assert f"Source {one.attribution}: {AFTER if one.attribution == ADAPTED else ''}" in lines
    assert not CALLED_PUBLISHED.search(lines)


@pytest.mark.parametrize("one", NOT_PUBLISHED, ids=lambda one: one.name)
def test_card_says_whose_the_law_is(one):
    made = card.make_card(one.regulator, "A law", ("", {}), "black", attribution=one.attribution)
    assert f'<span class="card-source">{one.attribution}: ' in made
    assert not CALLED_PUBLISHED.search(made)


def test_words_for_a_law_that_is_not_published_do_not_say_so():
    assert CALLED_PUBLISHED.search(IN_WORDS[PUBLISHED])
    assert [word for word in (ADAPTED, OURS, YOURS) if CALLED_PUBLISHED.search(IN_WORDS[word])] == []


def test_method_counts_every_law_of_the_catalogue_once():
    found = method.count_attributions()
    assert found[PUBLISHED] + found[ADAPTED] + found[OURS] == found["laws"] == len(contenders("regulators"))
    assert "MRP with memory" in found["adapted_laws"]
    ours = [law.display.short or law.name for law in contenders("regulators").values() if law.attribution == OURS]
    assert {"braking cascade with feedforward", "late braking"} <= set(ours)
    assert found["ours_laws"] == join_words(ours)

"""The page that reports link to: it has an anchor for each fault."""

import re

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole
from support.planted import PLANTED, audited

from bench.audit.report import PAGE, page
from bench.provenance import ROOT
from report.figures.libraries import check_your_error

PATH = ROOT / "report" / "pages" / f"{PAGE}.md"


def test_page_is_whole():
    assert_is_whole(check_your_error, None)


def test_every_finding_links_to_an_anchor_of_the_page():
    anchors = re.findall(r'id="([\w-]+)"', check_your_error.tables(None)["tab_faults"])
    links = {page(one) for function in list(PLANTED)[::4] for one in audited(function).findings}
    assert links
    for link in links:
        path, _, anchor = link.partition("#")
        assert ROOT / path == PATH
        assert anchors.count(anchor) == 1


def test_page_is_no_longer_than_800_words():
    assert len(PATH.read_text(encoding="utf-8").split()) <= 800

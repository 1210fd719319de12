"""The page on the audit, and the files that reports name."""

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from support.pages import assert_is_whole
from support.planted import PLANTED, audited

from bench.audit.report import file
from bench.base.provenance import ROOT
from report.figures.answer import take_it_home


def test_page_is_whole():
    assert_is_whole(take_it_home, None)


def test_every_finding_names_the_file_that_looks_for_it():
    findings = [one for function, _ in list(PLANTED.values())[::4] for one in audited(function).findings]
    assert findings
    for one in findings:
        assert one.fault.title in (ROOT / file(one)).read_text(encoding="utf-8")

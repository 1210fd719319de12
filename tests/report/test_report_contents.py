"""The book's table of contents takes every page there is or may be, once."""

import fnmatch
import re

import pytest

from bench.provenance import ROOT

REPORT = ROOT / "report"
GLOBS = re.findall(r"glob: (\S+)", (REPORT / "_toc.yml").read_text())


@pytest.mark.parametrize("number", range(1, 100))
def test_page_of_any_number_is_in_one_part(number):
    taken = [one for one in GLOBS if fnmatch.fnmatchcase(f"pages/{number:02d}-any-title", one)]
    assert len(taken) == 1


def test_every_page_has_a_number_of_its_own():
    numbers = [path.name[:3] for path in (REPORT / "pages").glob("*.md")]
    assert all(re.fullmatch(r"\d\d-", number) for number in numbers)
    assert len(set(numbers)) == len(numbers)

"""Each number and name that a lead takes from results, computed again from the tables by other code than the page's.

A key of a lead without a recomputation fails, so that a new lead needs one.
"""

import importlib
import re

import pytest
from support.leads import COMPUTED
from support.pages import RUN

from report.figures.kit.page import REPORT, kinds_of, modules_of, pasted, word_of

LEAD = re.compile(r"^(:{3,})\{div\} (?:lead|answer)\n(.*?)^\1$", re.DOTALL | re.MULTILINE)
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in (REPORT / "index.md", *REPORT.glob("pages/*.md"))}
NO_NUMBER = {"plane.quote"}
"""The paper's words, which test_conclusions has."""
UNITS = re.compile(r"1/s²?|rad²?/s[²³]|/s²")
SIGNS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789 ", "\u202f")


def paste_lead(text):
    """Return the keys that the lead of a page pastes; of the front page the answer."""
    parts = [one[1] for one in LEAD.findall(text)]
    return set(pasted("".join(parts))) - NO_NUMBER


def list_numbers(text):
    """Return every number of a text."""
    return [*map(float, re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", UNITS.sub("", text).translate(SIGNS)))]


@pytest.mark.parametrize("page", sorted({page for page, text in PAGES.items() if paste_lead(text)} | set(COMPUTED)))
def test_lead_says_what_the_tables_say(page, reference):
    text, said, computed = PAGES[page], {}, COMPUTED[page]()
    for name in modules_of(text):
        module = importlib.import_module(f"report.figures.{name}")
        if kinds_of(module, text) and hasattr(module, "facts"):
            facts = module.facts(RUN)
            said |= {f"{word_of(module, text)}{key}": str(value) for key, value in facts.items()}
    assert paste_lead(text) <= set(computed)
    for key, wanted in computed.items():
        if not isinstance(wanted, list):
            assert said[key].translate(SIGNS) == str(wanted), key
            continue
        assert list_numbers(said[key]) == pytest.approx(list_numbers(" ".join(map(str, wanted)))), (key, said[key])
        rest = said[key].lower()
        for words in (one.lower() for one in wanted if isinstance(one, str)):
            assert words in rest, (key, words, said[key])
            rest = rest.partition(words)[2]

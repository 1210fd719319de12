"""Tables that a reader sorts and filters, in the browser: the claims, by verdict and by word."""

import pytest
import screenshots

PAGE = screenshots.SITE / "pages" / "09-murphy-1988.html"
pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(bool(screenshots.missing(PAGE)), reason=screenshots.missing(PAGE) or "ready"),
]
COLUMN = """
return [...document.querySelector("table.sortable").tBodies[0].rows]
  .filter(row => !row.hidden).map(row => row.cells[arguments[0]].innerText.trim());
"""
IDS, VERDICTS = 0, 2


@pytest.fixture
def column(opened):
    screenshots.open_page(opened, PAGE, screenshots.VIEWS[0])
    return lambda index: opened.execute_script(COLUMN, index)


def head(driver, index):
    return driver.find_elements("css selector", "table.sortable th button")[index]


def test_a_head_sorts_and_the_third_press_restores(opened, column):
    first = column(IDS)
    head(opened, IDS).click()
    assert column(IDS) == sorted(first)
    head(opened, IDS).click()
    assert column(IDS) == sorted(first, reverse=True)
    head(opened, IDS).click()
    assert column(IDS) == first != sorted(first)


def test_a_head_says_how_it_sorts(opened, column):
    head(opened, VERDICTS).click()
    head(opened, IDS).click()
    states = [one.get_attribute("aria-sort") for one in opened.find_elements("css selector", "table.sortable th")]
    assert [states[IDS], states[VERDICTS]] == ["ascending", "none"]


def test_filter_leaves_rows_that_hold_the_words(opened, column):
    every, words = column(VERDICTS), "depends on the gains"
    opened.find_element("css selector", ".filter input").send_keys(words.upper())
    assert all(words in one for one in column(VERDICTS))
    told = f"{sum(words in one for one in every)} of {len(every)}"
    assert opened.find_element("css selector", ".filter output").text == told

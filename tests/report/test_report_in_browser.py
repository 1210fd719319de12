"""Every page of the built report as a reader's browser sees it, in light and dark, wide and narrow; claims sorted."""

import base64
import importlib.resources

import pytest
import screenshots
from support import pdf

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(bool(screenshots.missing()), reason=screenshots.missing() or "ready"),
]

PAGES = [] if screenshots.missing() else screenshots.pages()

# A canvas is read from a copy: Chromium warns of one that is read twice.
FACTS = """
const root = document.documentElement, heading = document.querySelector("article h1");
const shown = [...document.images].filter(image => image.src && image.getClientRects().length);
const formulas = [...document.querySelectorAll("article math, article div.math")];
const copied = c => {
  const copy = Object.assign(document.createElement("canvas"), {width: c.width, height: c.height}).getContext("2d");
  copy.drawImage(c, 0, 0);
  return copy;
};
const inked = c => copied(c).getImageData(0, 0, c.width, c.height).data.some(byte => byte);
const boxes = range => [...range.getClientRects()].filter(box => box.width > 0.5);
const lines = range => new Set(boxes(range).map(box => Math.round(box.bottom / 6))).size;
const spans = (node, from, to) => {
  const range = document.createRange();
  range.setStart(node, from);
  range.setEnd(node, to);
  return range;
};
const texts = root => {
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT), found = [];
  while (walker.nextNode()) if (walker.currentNode.parentElement.checkVisibility()) found.push(walker.currentNode);
  return found;
};
const cells = [...document.querySelectorAll("article table :is(td, th)")].flatMap(texts);
const words = cells.flatMap(node => [...node.data.matchAll(/[\\p{L}\\d]{2,}/gu)].map(word => [node, word]));
const isDigest = text => /^[0-9a-f]{32,}$/.test(text);  // no word, and wider than a phone
const isTorn = ([node, word]) => lines(spans(node, word.index, word.index + word[0].length)) > 1;
const torn = words.filter(pair => !isDigest(pair[1][0]) && isTorn(pair));
const marks = [...document.querySelectorAll("article math:not([display=block])")].filter(math => {
  const next = math.nextSibling;
  if (!next || next.nodeType !== 3 || !/^[,.;:)]/.test(next.data) || !math.checkVisibility()) return false;
  return spans(next, 0, 1).getBoundingClientRect().left < math.getBoundingClientRect().left;
});
const unset = one => (one.checkVisibility() && !one.getBoundingClientRect().width) || one.textContent.includes("\\\\");
return {
  theme: root.dataset.theme,
  heading: heading ? heading.innerText.trim() : "",
  overflow: Math.max(root.scrollWidth, document.body.scrollWidth) - root.clientWidth,
  broken: shown.filter(image => !image.complete || image.naturalWidth === 0).map(image => image.src),
  empty: [...document.querySelectorAll("canvas.ball")].filter(c => !inked(c)).map(c => c.id),
  cut: [...document.querySelectorAll("article table")]
    .filter(table => table.parentElement.scrollWidth > table.parentElement.clientWidth + 1)
    .map(table => table.id || table.className),
  unset: formulas.filter(unset).length,
  torn: torn.map(([node, word]) => word[0]),
  marks: marks.map(math => math.parentElement.innerText.slice(0, 80)),
};
"""

PHONE = screenshots.View("light", 390)
EIGHTEEN_COLUMNS = "tab-side-by-side"
IN_A_FOLD = "plain evidence"
"""Tables of up to ten columns in the folds of the claims, which scroll in their box."""
"""The one table that scrolls sideways."""

# All of axe-core's rules, and one that it leaves out unless asked; colours that are still changing are not looked at.
BARRIERS = """
const done = arguments[arguments.length - 1], rules = {"label-content-name-mismatch": {enabled: true}};
const still = document.createElement("style");
still.textContent = "* { transition: none !important; animation: none !important }";
document.head.append(still);
const wait = ms => new Promise(after => setTimeout(after, ms)); // the theme looks again 0.3 s after a change of width
const asked = {resultTypes: ["violations"], iframes: false, rules};
wait(600).then(() => axe.run(document, asked)).then(found => done(found.violations
  .flatMap(one => one.nodes.map(node => `${one.id}: ${node.html.slice(0, 200)}`))));
"""

PAPER_PIXELS = 703
"""The width of A4 between margins of 12 mm, at 96 pixels an inch."""
CROPPED = """
const right = document.documentElement.clientWidth + 1;
const shown = [...document.querySelectorAll("article :is(table, svg, pre, math, p, figcaption)")];
return shown.filter(one => one.checkVisibility() && one.getBoundingClientRect().right > right)
  .map(one => `${one.tagName} ${one.id} ${one.textContent.slice(0, 60)}`);
"""


@pytest.fixture(scope="module")
def axe():
    return importlib.resources.files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")


@pytest.fixture(scope="module", params=PAGES, ids=lambda page: page.stem)
def seen(request, opened, axe):
    """What one page shows in two views, with all that it asked of the network and told the console, and its barriers.

    Each page is opened in one view, and then looked at in the other theme and width, as when a reader turns a phone
    into the night. Pages take turns in which view they are opened in.
    """
    turn = PAGES.index(request.param) % len(screenshots.VIEWS)
    first, second = screenshots.VIEWS[turn], screenshots.VIEWS[-1 - turn]
    screenshots.open_page(opened, request.param, first)
    facts = {first: opened.execute_script(FACTS)}
    screenshots.look(opened, second)
    screenshots.settle(opened)
    facts[second] = opened.execute_script(FACTS)
    told = screenshots.network_requests(opened), screenshots.console_errors(opened)
    opened.execute_script(axe)
    barriers = opened.execute_async_script(BARRIERS)
    screenshots.console_errors(opened)  # axe-core reads a canvas of its own many times, of which Chromium warns
    screenshots.look(opened, screenshots.View("light", PAPER_PIXELS), media="print")
    cropped = opened.execute_script(CROPPED)
    screenshots.look(opened, second)
    return facts, *told, barriers, cropped


def test_page_asks_nothing_of_the_network(seen):
    assert seen[1] == []


def test_page_makes_no_console_error(seen):
    assert seen[2] == []


def test_page_keeps_nobody_out(seen):
    assert seen[3] == []


def test_page_follows_the_readers_theme(seen):
    assert {view: facts["theme"] for view, facts in seen[0].items()} == {view: view.theme for view in seen[0]}


def test_page_never_scrolls_sideways(seen):
    assert {view: facts["overflow"] for view, facts in seen[0].items() if facts["overflow"] > 0} == {}


def test_no_table_is_cut_off_on_a_wide_screen(seen):
    cut = {table for view, facts in seen[0].items() if view.width > 1000 for table in facts["cut"]}
    assert cut - {EIGHTEEN_COLUMNS, IN_A_FOLD} == set()


def test_print_crops_nothing(seen):
    assert seen[4] == []


def test_cells_break_no_word_and_no_line_begins_with_punctuation(seen):
    assert [facts["torn"] + facts["marks"] for facts in seen[0].values()] == [[], []]


def test_page_has_a_main_heading(seen):
    assert all(facts["heading"] for facts in seen[0].values())


def test_page_shows_every_image_ball_and_formula(seen):
    for facts in seen[0].values():
        assert (facts["broken"], facts["empty"], facts["unset"]) == ([], [], 0)


@pytest.mark.parametrize(
    ("menu", "dialog"),
    [("primary-toggle", "pst-primary-sidebar-modal"), ("secondary-toggle", "pst-secondary-sidebar-modal")],
)
def test_menu_of_a_phone_keeps_nobody_out(opened, axe, menu, dialog):
    screenshots.open_page(opened, screenshots.SITE / "pages" / "06-what-an-error-must-do.html", PHONE)
    buttons = opened.find_elements("css selector", f".{menu}")
    [button] = [one for one in buttons if one.is_displayed()]
    button.click()
    screenshots.settle(opened)
    opened.execute_script(axe)
    assert opened.execute_script("return document.getElementById(arguments[0]).open", dialog)
    assert opened.execute_async_script(BARRIERS) == []


CHAPTERS = [page for page in PAGES if page.parent.name == "pages" and page.stem[:2].isdigit()]


@pytest.mark.parametrize("page", CHAPTERS, ids=lambda page: page.stem)
def test_printed_chapter_has_no_half_empty_page_before_its_last(opened, page):
    screenshots.open_page(opened, page, screenshots.View("light", 1280))
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    printed = opened.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True})
    sheets = pdf.read_pages(base64.b64decode(printed["data"]))
    assert {
        number: sheet.largest_gap() for number, sheet in enumerate(sheets[:-1], 1) if sheet.largest_gap() > 0.5
    } == {}


@pytest.mark.parametrize("theme", screenshots.THEMES)
def test_film_of_the_other_theme_is_not_loaded(opened, theme):
    from selenium.webdriver.support.wait import WebDriverWait

    page = screenshots.SITE / "pages" / "04-euler-jacobian.html"
    screenshots.requests(opened)
    screenshots.open_page(opened, page, screenshots.View(theme, 1280))
    film = opened.find_element("css selector", "video[data-film]")
    opened.execute_script("arguments[0].scrollIntoView()", film)
    WebDriverWait(opened, 20).until(lambda driver: driver.execute_script("return arguments[0].currentSrc", film))
    loaded = [url for url in screenshots.requests(opened) if "-loop" in url]
    assert {"-dark" in url for url in loaded} == {theme == "dark"}


EDGES = """
const edges = found => [...document.querySelectorAll(found)].map(one => one.getBoundingClientRect());
const tops = edges("article h1, article .lead, #fig-headline").map(box => box.top);
return [tops, edges("#tab-headline tbody tr").map(box => box.bottom)];
"""
CONCLUSIONS = 8


def test_front_page_concludes_on_its_first_two_screens(opened):
    screenshots.open_page(opened, screenshots.SITE / "index.html", screenshots.View("light", 1280))
    tops, feet = opened.execute_script(EDGES)
    assert len(tops) == 3
    assert tops == sorted(tops)
    assert len(feet) == CONCLUSIONS
    assert tops[-1] < screenshots.HEIGHT
    assert max(feet) <= 2 * screenshots.HEIGHT


def test_front_page_shows_its_figure_on_the_second_screen_of_a_phone(opened):
    screenshots.open_page(opened, screenshots.SITE / "index.html", screenshots.View("light", 390))
    tops, _ = opened.execute_script(EDGES)
    assert tops[1] < 844
    assert tops[2] < 2 * 844


def test_ten_chapters_stay_short(opened):
    count = "return [document.querySelector('main').scrollHeight, ...['table', 'figure'].map(x => "
    count += "document.querySelectorAll(`article ${x}`).length)]"
    sizes = []
    for page in CHAPTERS:
        screenshots.open_page(opened, page, screenshots.View("light", 1280))
        sizes.append(opened.execute_script(count))
    pixels, tables, figures = map(sum, zip(*sizes, strict=True))
    assert len(CHAPTERS) == 10
    # Chapter 1 has a figure for each figure of the paper; what is looked up (index, symbols) is in the appendix.
    assert pixels <= 44 * screenshots.HEIGHT
    assert tables <= 20
    assert figures <= 23


@pytest.mark.parametrize("words", ["180", "gimbal lock", "install"])
def test_search_from_a_file_finds_pages_without_an_error(opened, words):
    from selenium.webdriver.support.wait import WebDriverWait

    screenshots.console_errors(opened)
    opened.get(f"{(screenshots.SITE / 'search.html').as_uri()}?q={words}")
    WebDriverWait(opened, 20).until(lambda _: opened.find_elements("css selector", "#search-results li a"))
    assert not [line for line in opened.get_log("browser") if "rror" in line["message"]]


CLAIMS = screenshots.SITE / "pages" / "appendix-claims.html"
COLUMN = """
return [...document.querySelector("table.sortable").tBodies[0].rows]
  .filter(row => !row.hidden).map(row => row.cells[arguments[0]].innerText.trim());
"""
IDS, VERDICTS = 0, 2


@pytest.fixture
def column(opened):
    screenshots.open_page(opened, CLAIMS, screenshots.VIEWS[0])
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

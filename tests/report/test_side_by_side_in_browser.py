"""The page on which two laws are seen side by side, in a browser: keyboard, phone, address, and without a script."""

import pytest

pytest.importorskip("selenium", reason="the dev extra is not installed (cure: make setup)")
import screenshots
from selenium.webdriver.support.ui import WebDriverWait

PAGE = screenshots.SITE / "pages" / "26-side-by-side.html"
PHONE, DESK = screenshots.View("light", 360), screenshots.View("dark", 1280)


def missing():
    """Why the page cannot be operated here; empty if it can."""
    if screenshots.missing():
        return screenshots.missing()
    if not PAGE.is_file() or 'id="side-by-side"' not in PAGE.read_text(encoding="utf-8"):
        return "the built report is of a run without curves to show (cure: make bench, make report)"
    return ""


# Every law as B, each from every fourth or fifth start.
DRAW_ALL = """
const part = name => document.getElementById(`side-${name}`), broken = [];
const pick = (name, index) => { part(name).selectedIndex = index; part(name).dispatchEvent(new Event("change")); };
for (let start = 0; start < part("start").length; start += arguments[0]) {
  pick("start", start);
  for (let law = 0; law < part("b").length; law++) {
    pick("b", law);
    const drawn = part("angle").innerHTML + part("command").innerHTML;
    if (/NaN|undefined|Infinity/.test(drawn)) broken.push(part("b").value);
  }
}
return broken;
"""

pytestmark = [pytest.mark.browser, pytest.mark.skipif(bool(missing()), reason=missing() or "ready")]


@pytest.fixture(scope="module")
def opened():
    with screenshots.browser() as driver:
        yield driver


@pytest.fixture
def driver(opened):
    """The page as it opens."""
    show(opened)
    return opened


def show(driver, address="", view=DESK):
    driver.get("about:blank")  # or a new address of the same page would load nothing
    screenshots.look(driver, view)
    driver.get(PAGE.as_uri() + address)
    screenshots.settle(driver)


def press(driver, name, key):
    """A key while the control has the focus, as after so many tabs."""
    driver.execute_script("arguments[0].focus()", part(driver, name))
    driver.switch_to.active_element.send_keys(key)


def part(driver, name):
    return driver.find_element("id", f"side-{name}")


def said(driver):
    return part(driver, "said").text


@pytest.mark.parametrize(("name", "line"), [("start", 0), ("a", 1), ("b", 2)])
def test_choice_by_keyboard_changes_its_sentence_alone(driver, name, line):
    before = said(driver).splitlines()
    press(driver, name, "\ue015")  # arrow down
    after = said(driver).splitlines()
    assert before[line] != after[line]
    endings = [(one.split()[1:2], other.split()[1:2]) for one, other in zip(before, after, strict=True)]
    assert [one != other for one, other in endings[1:]] == [name == "a", name == "b"]


def test_next_and_previous_walk_through_all_starts_and_around(driver):
    count = len(driver.find_elements("css selector", "#side-start option"))
    first, seen = said(driver), []
    for _ in range(count):
        press(driver, "next", "\ue007")  # enter
        seen.append(said(driver))
    assert seen[-1] == first
    assert len(set(seen)) > count // 2
    press(driver, "previous", "\ue007")
    assert said(driver) == seen[-2]


def test_slider_by_keyboard_moves_the_marks_and_says_the_angles(driver):
    before = part(driver, "angle").get_attribute("innerHTML")
    press(driver, "time", "\ue014")  # arrow right
    assert part(driver, "now").text == "0.02 s"
    assert part(driver, "angle").get_attribute("innerHTML") != before
    assert part(driver, "time").get_attribute("aria-valuetext").startswith("0.02 s: A ")


def test_play_runs_the_clock_and_pause_stops_it(driver):
    press(driver, "play", "\ue007")
    assert part(driver, "play").text == "Pause"
    WebDriverWait(driver, screenshots.LOAD_SECONDS).until(lambda _: part(driver, "now").text != "0.00 s")
    press(driver, "play", "\ue007")
    assert part(driver, "play").text == "Play"
    stopped = part(driver, "now").text
    screenshots.settle(driver)
    assert part(driver, "now").text == stopped


def test_nothing_moves_by_itself(driver):
    screenshots.settle(driver)
    assert (part(driver, "now").text, part(driver, "play").text) == ("0.00 s", "Play")


def test_address_holds_the_view(driver):
    press(driver, "a", "\ue015")
    press(driver, "next", "\ue007")
    press(driver, "log", " ")
    shown, drawn = said(driver), part(driver, "angle").get_attribute("innerHTML")
    WebDriverWait(driver, screenshots.LOAD_SECONDS).until(lambda _: "log=1" in driver.current_url)
    address = driver.execute_script("return location.hash")
    show(driver, address)
    assert said(driver) == shown
    assert part(driver, "angle").get_attribute("innerHTML") == drawn


def test_link_to_a_heading_leaves_the_view(driver):
    press(driver, "next", "\ue007")
    shown = said(driver)
    driver.execute_script("location.hash = 'every-law-from-every-start'")
    assert said(driver) == shown


def test_each_preset_shows_another_view(driver):
    buttons, seen = driver.find_elements("css selector", "[data-view]"), {said(driver)}
    for button in buttons:
        driver.execute_script("arguments[0].focus()", button)
        button.send_keys("\ue007")
        screenshots.settle(driver)
        seen.add(said(driver))
    assert len(seen) == len(buttons) + 1


@pytest.mark.parametrize("is_log", [False, True])
def test_every_law_draws_numbers_alone_and_asks_nothing_of_the_network(driver, is_log):
    screenshots.network_requests(driver), screenshots.console_errors(driver)
    driver.execute_script("document.getElementById('side-log').checked = arguments[0]", is_log)
    broken = driver.execute_script(DRAW_ALL, 4 + is_log)
    assert (broken, screenshots.network_requests(driver), screenshots.console_errors(driver)) == ([], [], [])


@pytest.mark.parametrize("view", [PHONE, DESK])
def test_ball_has_ink_and_nothing_is_wider_than_the_window(driver, view):
    show(driver, view=view)
    root = "document.documentElement"
    assert driver.execute_script(f"return {root}.scrollWidth - {root}.clientWidth") <= 0
    assert driver.execute_script(
        "const c = document.getElementById('side-ball');"
        "return c.width > 200 && c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some(byte => byte)"
    )


def test_controls_are_large_enough_for_a_finger(driver):
    show(driver, view=PHONE)
    for name in ("a", "b", "start", "previous", "next", "play", "time"):
        assert part(driver, name).size["height"] >= 40


def test_page_without_a_script_shows_the_table_and_no_dead_control(driver):
    driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        driver.get("about:blank")
        driver.get(PAGE.as_uri())
        assert not driver.find_element("id", "side-by-side").is_displayed()
        assert driver.find_element("css selector", "table.table").is_displayed()
    finally:
        driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})

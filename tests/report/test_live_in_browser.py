"""The live page in a browser: episodes as recorded, keyboard, drag, address, copies, phone, and without a script."""

import json

import pytest
import screenshots
import stills
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

PAGE = screenshots.SITE / "pages" / "10-try-it.html"
PHONE, DESK = screenshots.View("light", 360), screenshots.View("dark", 1280)
ARROW_RIGHT, HOME, END, ENTER = "\ue014", "\ue011", "\ue010", "\ue007"


MISSING = screenshots.missing(PAGE)
pytestmark = [pytest.mark.browser, pytest.mark.skipif(bool(MISSING), reason=MISSING or "ready")]


@pytest.fixture
def driver(opened):
    """The page as it opens."""
    show(opened)
    return opened


def show(driver, address="", view=DESK, motion="reduce"):
    driver.get("about:blank")  # or a new address of the same page would load nothing
    screenshots.look(driver, view)
    wanted = {"name": "prefers-reduced-motion", "value": motion}, {"name": "prefers-color-scheme", "value": view.theme}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": wanted})
    driver.get(PAGE.as_uri() + address)
    screenshots.settle(driver)
    wait(driver, lambda: is_said(driver))
    driver.execute_script("document.querySelectorAll('details').forEach(one => { one.open = true; })")


def wait(driver, fact):
    return WebDriverWait(driver, screenshots.LOAD_SECONDS).until(lambda _: fact())


def part(driver, name):
    return driver.find_element("id", f"live-{name}")


def said(driver):
    return part(driver, "said").text


def is_said(driver):
    """Whether the verdict is that of the episodes which are shown."""
    return part(driver, "said").get_attribute("aria-busy") == "false"


def press(driver, name, key):
    """A key while the control has the focus, as after so many tabs."""
    driver.execute_script("arguments[0].focus()", part(driver, name))
    driver.switch_to.active_element.send_keys(key)


def changed(driver, act):
    """What is said after the act, once it differs."""
    before = said(driver)
    act()
    return wait(driver, lambda: is_said(driver) and said(driver) != before and said(driver))


def test_a_dot_of_the_ball_is_a_start_that_plays(driver):
    show(driver, motion="no-preference")
    counted = wait_for_all_starts(driver)
    assert counted.endswith("at exactly 180°: 629 of 629; elsewhere: 0 of 3,581.")
    changed(driver, ActionChains(driver).move_to_element_with_offset(part(driver, "ball"), 30, 40).click().perform)
    assert part(driver, "start").get_attribute("value") == "own"
    assert wait(driver, lambda: part(driver, "play").text == "Pause")


def wait_for_all_starts(driver):
    """What is said of the ball's starts once all of them are computed."""
    wait(driver, lambda: part(driver, "counted").get_attribute("aria-busy") == "false")
    return part(driver, "counted").text


def ends_of_the_scale(driver):
    return [part(driver, f"ramp-{end}").text for end in ("from", "to")]


def test_colours_have_one_scale_for_both_laws_and_it_is_not_wider_than_their_times(driver):
    show(driver, "#peak-command")
    wait_for_all_starts(driver)
    of_a = ends_of_the_scale(driver)
    driver.execute_script("arguments[0].value = 'b'", part(driver, "colouring"))
    driver.execute_script("arguments[0].dispatchEvent(new Event('change'))", part(driver, "colouring"))
    wait_for_all_starts(driver)
    assert ends_of_the_scale(driver) == of_a
    fastest, slowest = (float(words.strip("≤≥ s")) for words in of_a)
    assert 0.4 < fastest < slowest < 0.8


def test_ring_goes_from_dot_to_dot_and_enter_starts_there(driver):
    wait_for_all_starts(driver)
    press(driver, "ball", Keys.ARROW_LEFT)
    first = wait(driver, lambda: part(driver, "dot").text)
    assert "from the goal, settles in" in first
    part(driver, "ball").send_keys(Keys.SHIFT, *3 * [Keys.ARROW_DOWN], Keys.NULL)
    second = wait(driver, lambda: part(driver, "dot").text != first and part(driver, "dot").text)
    changed(driver, lambda: part(driver, "ball").send_keys(ENTER))
    assert part(driver, "start").get_attribute("value") == "own"
    assert part(driver, "angle-now").text in second


@pytest.mark.parametrize("name", ["slow", "unwinding", "sensor-off", "gimbal-lock"])
def test_verdict_of_the_last_example_is_gone_as_soon_as_another_is_chosen(driver, name):
    show(driver, "#stuck")
    script = "arguments[0].click(); return [...arguments[1].children].map(one => one.textContent)"
    button = driver.find_element("css selector", f"[data-preset={name}]")
    assert all(line.endswith("computing …") for line in driver.execute_script(script, button, part(driver, "said")))
    assert "Computing" in part(driver, "counted").text


def test_page_rests_where_the_slower_body_is_half_way(driver):
    show(driver, "#slow")
    angles = wait(driver, lambda: part(driver, "time").get_attribute("aria-valuetext"))
    a, b = (float(words.split()[-1].rstrip("°")) for words in angles.split(": ")[1].split(", "))
    assert b < 1.0
    assert 70.0 < a < 90.0


@pytest.mark.parametrize("view", [PHONE, DESK])
def test_chapter_shows_the_ball_of_its_scene_whole(driver, view):
    chapter = PAGE.with_name("06-what-an-error-must-do.html")
    screenshots.open_page(driver, chapter, view)
    frame = driver.find_element("css selector", ".ball-view iframe")
    driver.execute_script("arguments[0].scrollIntoView()", frame)
    driver.switch_to.frame(frame)
    wait_for_all_starts(driver)
    wait(driver, lambda: driver.execute_script("return innerHeight - document.body.scrollHeight") >= 0)
    assert driver.execute_script("return document.documentElement.dataset.theme") == view.theme
    assert (part(driver, "a").get_attribute("value"), part(driver, "off").get_attribute("value")) == ("mrp", "0.1")
    shown = {name: part(driver, name).is_displayed() for name in ("ball", "off", "play", "gripper", "angle-plot")}
    assert shown == {"ball": True, "off": True, "play": True, "gripper": False, "angle-plot": False}
    driver.switch_to.default_content()


def test_link_that_is_copied_is_the_short_one_of_the_preset(driver):
    show(driver, "#unwinding")
    press(driver, "link", ENTER)
    assert wait(driver, lambda: part(driver, "link").get_attribute("data-copied")) == f"{PAGE.as_uri()}#unwinding"


def test_exact_half_turn_by_a_slider_is_a_dead_point_of_the_first_law(driver):
    after = changed(driver, lambda: press(driver, "angle", END))
    assert "A: rotation matrix is stuck 180° from the goal." in after
    assert part(driver, "start").get_attribute("value") == "own"


def test_dragged_gripper_turns_the_start(driver):
    drag = ActionChains(driver).click_and_hold(part(driver, "gripper")).move_by_offset(60, 30).release()
    changed(driver, drag.perform)
    assert part(driver, "start").get_attribute("value") == "own"
    assert part(driver, "angle-now").text != "179.43°"


def test_sliders_say_their_value_and_change_the_episode(driver):
    after = changed(driver, lambda: press(driver, "rate", HOME))
    assert (part(driver, "rate-now").text, part(driver, "rate").get_attribute("aria-valuetext")) == (
        "10 Hz",
        "10\xa0Hz",
    )
    press(driver, "reset", ENTER)
    assert wait(driver, lambda: said(driver) != after)
    assert part(driver, "rate-now").text == "1000 Hz"


def test_address_holds_the_view(driver):
    press(driver, "delay", 20 * ARROW_RIGHT)
    changed(driver, lambda: press(driver, "gripper", 5 * ARROW_RIGHT))
    press(driver, "log", " ")
    wait(driver, lambda: "log=1" in driver.current_url and "q=" in driver.current_url)
    shown, drawn = said(driver), drawn_at_the_start(driver)
    address = driver.execute_script("return location.hash")
    show(driver, address)
    assert said(driver) == shown
    assert drawn_at_the_start(driver) == drawn


def drawn_at_the_start(driver):
    press(driver, "time", HOME)
    return part(driver, "angle-plot").get_attribute("innerHTML")


@pytest.mark.parametrize("address", ["#a=none&b=", "#a=mrp&q=0,0,0,0&kp=nine", "#b=mrp&q=1,2&rate=1e9&start=nowhere"])
def test_address_with_mistakes_shows_what_can_be_shown(driver, address):
    screenshots.console_errors(driver)
    show(driver, address)
    assert len(said(driver).splitlines()) == 2
    assert screenshots.console_errors(driver) == []


def test_link_to_a_heading_leaves_the_view(driver):
    shown = changed(driver, lambda: press(driver, "next", ENTER))
    driver.execute_script("location.hash = 'try-two-laws'")
    screenshots.settle(driver)
    assert said(driver) == shown


def test_each_preset_shows_another_view_draws_numbers_alone_and_asks_nothing_of_the_network(driver):
    screenshots.network_requests(driver), screenshots.console_errors(driver)
    buttons, seen = driver.find_elements("css selector", "[data-preset]"), {said(driver)}
    for button in buttons[1:]:  # the page opens with the first
        driver.execute_script("arguments[0].focus()", button)
        seen.add(changed(driver, lambda here=button: here.send_keys(ENTER)))
        drawn = "".join(
            one.get_attribute("innerHTML") for one in driver.find_elements("css selector", ".live-plots svg")
        )
        assert not [word for word in ("NaN", "undefined", "Infinity") if word in drawn]
    assert len(seen) == len(buttons)
    assert (screenshots.network_requests(driver), screenshots.console_errors(driver)) == ([], [])


def test_page_plays_once_unless_the_reader_wants_no_motion_and_pause_stops_it(driver):
    assert part(driver, "play").text == "Play"
    show(driver, "#stuck", motion="no-preference")
    wait(driver, lambda: part(driver, "now").text != "0.00 s")
    press(driver, "play", ENTER)
    stopped = part(driver, "now").text
    screenshots.settle(driver)
    assert part(driver, "now").text == stopped


def test_copied_law_is_the_text_of_what_runs(driver):
    button = driver.find_element("css selector", ".live-code button")
    driver.execute_script("arguments[0].focus()", button)
    button.send_keys(ENTER)
    text = wait(driver, lambda: driver.find_element("css selector", ".live-code button").get_attribute("data-copied"))
    assert "function turn_matrix(R, R_d)" in text or "function cross(p, q)" in text
    assert driver.execute_script("return Object.values(live.functions).some(one => arguments[0].includes(one))", text)


@pytest.mark.parametrize("view", [PHONE, DESK])
@pytest.mark.parametrize("name", ["ball", "gripper"])
def test_pictures_have_ink_and_nothing_is_wider_than_the_window(driver, view, name):
    show(driver, view=view)
    root = "document.documentElement"
    assert driver.execute_script(f"return {root}.scrollWidth - {root}.clientWidth") <= 0
    assert driver.execute_script(
        "const c = document.getElementById(`live-${arguments[0]}`);"
        "return c.width > 150 && c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some(byte => byte)",
        name,
    )


def test_controls_are_large_enough_for_a_finger(driver):
    show(driver, view=PHONE)
    for name in ("a", "b", "start", "previous", "next", "play", "time", "angle", "rate"):
        assert part(driver, name).size["height"] >= 40


def test_page_without_a_script_says_so_and_shows_no_dead_control(driver):
    driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        driver.get("about:blank")
        driver.get(PAGE.as_uri())
        assert not part(driver, "page").is_displayed()
        assert "needs JavaScript" in driver.find_element("css selector", "noscript p").text
        stills = driver.find_elements("css selector", ".live-stills img")
        assert len(stills) == 4
        assert all(one.is_displayed() for one in stills)
    finally:
        driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


@pytest.mark.parametrize("name", ["stuck", "unwinding", "sensor-off", "gimbal-lock"])
def test_picture_of_an_example_says_what_the_page_says(driver, name):
    recorded = json.loads(stills.RECORD.read_text(encoding="utf-8"))
    assert stills.open_example(driver, name) == recorded[name]

"""The built report in headless Chromium, by selenium (the dev extra) and Debian's chromium and chromium-driver."""

import contextlib
import importlib.util
import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import check_site

SITE = Path(__file__).resolve().parent / "_build" / "html"
THEMES = ("light", "dark")
WIDTHS = (1280, 390)
HEIGHT = 900
LOAD_SECONDS = 90  # a page needs less than one, a whole ball some; the rest is for a loaded machine
LOCAL_SCHEMES = ("file:", "data:", "blob:", "about:", "chrome:")
CURE = "apt-get install chromium chromium-driver; pip install selenium"

WAIT_FOR_QUIET = """
const done = arguments[arguments.length - 1];
const frame = () => new Promise(requestAnimationFrame);
document.fonts.ready.then(frame).then(frame).then(() => done(true));
"""


class View(NamedTuple):
    """One way of looking at a page."""

    theme: str
    width: int


VIEWS = [View(theme, width) for theme in THEMES for width in WIDTHS]


def missing(page: Path = SITE / "index.html") -> str:
    """Return why the page cannot be opened here, in one line with the cure; empty where it can."""
    if importlib.util.find_spec("selenium") is None:
        return f"selenium is not installed (cure: {CURE})"
    for program, found in (("chromium", chromium()), ("chromedriver", shutil.which("chromedriver"))):
        if not found:
            return f"{program} is not on this machine (cure: {CURE})"
    if not page.is_file():
        return "the report is not built (cure: make report)"
    return ""


def chromium() -> str | None:
    """Return the browser's program, under the first of its names that is here."""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def pages() -> list[Path]:
    """Return the pages people read."""
    return [path for path in check_site.html_files(SITE) if path.name not in check_site.GENERATED]


@contextlib.contextmanager
def browser() -> Iterator:
    """Open a headless Chromium that keeps its console and its network log."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options: Any = webdriver.ChromeOptions()
    options.binary_location = chromium()
    for switch in (
        "--headless=new",
        "--no-sandbox",
        "--disable-dev-shm-usage",
        "--disable-gpu",
        "--hide-scrollbars",
    ):
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    driver.set_script_timeout(LOAD_SECONDS)
    driver.set_page_load_timeout(LOAD_SECONDS)
    try:
        yield driver
    finally:
        driver.quit()


def look(driver: Any, view: View, media: str = "screen") -> None:
    """Set width, theme and medium (screen or print) as a reader's device would, before or after a page is opened."""
    size = {"width": view.width, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": view.width < 600}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    scheme = {"media": media, "features": [{"name": "prefers-color-scheme", "value": view.theme}]}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", scheme)


def settle(driver: Any) -> None:
    """Wait until formulas are set, fonts are there and the page is drawn."""
    driver.execute_async_script(WAIT_FOR_QUIET)


def open_page(driver: Any, page: Path, view: View) -> None:
    """Open a page from its file and wait until it is drawn."""
    look(driver, view)
    driver.get(page.as_uri())
    settle(driver)


def requests(driver: Any) -> list[str]:
    """Return every address that was asked for since the last call."""
    asked = []
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] in ("Network.requestWillBeSent", "Network.webSocketCreated"):
            parameters = message["params"]
            asked.append(parameters.get("url") or parameters["request"]["url"])
    return asked


def network_requests(driver: Any) -> list[str]:
    """Return every address outside this machine that was asked for since the last call."""
    return [url for url in requests(driver) if not url.startswith(LOCAL_SCHEMES)]


def console_errors(driver: Any) -> list[str]:
    """Return what the console complained of since the last call."""
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]

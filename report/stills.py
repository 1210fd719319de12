"""Photograph the live page's examples, for readers without JavaScript and for paper.

    python report/stills.py     after make report; into report/_static/media (needs chromium)

live.json holds what the page says of each example. It is the alternative text of the picture, and a
test compares it with what the page says.
"""

import base64
import io
import json
import sys
from typing import Any

import screenshots
from drawing import MEDIA, save
from PIL import Image

PAGE = screenshots.SITE / "pages" / "10-try-it.html"
RECORD = MEDIA / "live.json"
VIEW = screenshots.View("light", 1100)
SHARPNESS = 1.5  # pixels of a picture to one of the page
MARGIN = 8
# What is no use on paper goes, and the law whose times are the colours is written out.
PREPARE = """
for (const one of document.querySelectorAll(".live-clock, .live-check, .live-cut, .live-dot")) one.remove();
document.querySelector(".live-colouring").textContent = "Settling time of law A";
document.querySelector(".live-views").scrollIntoView();
const box = document.querySelector(".live-views").getBoundingClientRect();
const edge = arguments[0], around = { width: box.width + 2 * edge, height: box.height + 2 * edge };
return { x: box.x + scrollX - edge, y: box.y + scrollY - edge, ...around };
"""
IS_SAID = """
const parts = [...document.querySelectorAll("#live-said, #live-counted")];
return parts.every(one => one.getAttribute("aria-busy") === "false");
"""
SAID = """
const lines = [...document.querySelectorAll("#live-said span")].map(one => one.textContent);
return [...lines, document.getElementById("live-counted").textContent];
"""
PRESETS = "return [...document.querySelectorAll('[data-preset]')].map(one => one.dataset.preset)"
REDUCED = {"name": "prefers-reduced-motion", "value": "reduce"}


def open_example(driver: Any, name: str) -> list[str]:
    """Open the live page at an example, wait until all its starts are computed, and return what it says."""
    from selenium.webdriver.support.wait import WebDriverWait

    driver.get("about:blank")  # a new fragment alone would not load the page again
    screenshots.look(driver, VIEW)
    scheme = {"name": "prefers-color-scheme", "value": VIEW.theme}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme, REDUCED]})
    driver.get(f"{PAGE.as_uri()}#{name}")
    driver.execute_script("document.getElementById('live-ball').scrollIntoView()")
    WebDriverWait(driver, 10 * screenshots.LOAD_SECONDS).until(lambda _: driver.execute_script(IS_SAID))
    screenshots.settle(driver)
    return driver.execute_script(SAID)


def photograph(driver: Any) -> Image.Image:
    """Return the picture of the example that is open."""
    size = {"width": VIEW.width, "height": screenshots.HEIGHT, "deviceScaleFactor": SHARPNESS, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    box = driver.execute_script(PREPARE, MARGIN)
    screenshots.settle(driver)
    asked = {"clip": {**box, "scale": 1}, "captureBeyondViewport": True}
    picture = driver.execute_cdp_cmd("Page.captureScreenshot", asked)
    return Image.open(io.BytesIO(base64.b64decode(picture["data"]))).convert("RGB")


def main() -> int:
    """Photograph every example and record what the page says of it."""
    if missing := screenshots.missing(PAGE):
        print(f"stills: {missing}", file=sys.stderr)
        return 2
    record = {}
    with screenshots.browser() as driver:
        driver.get(PAGE.as_uri())
        for name in driver.execute_script(PRESETS):
            record[name] = open_example(driver, name)
            save(photograph(driver), f"live-{name}.png")
            print(f"stills: {name}")
    RECORD.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

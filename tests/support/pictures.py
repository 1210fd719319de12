"""What every drawing of the book is held to."""

import re

from report.figures.kit import style

TWINS = {colour.lower() for pair in style.TWINS.items() for colour in pair}
COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b")
IMAGE = re.compile(r'"data:[^"]*"')


def hold_to_page(picture):
    """It says its numbers in words, uses colours of the palette only, and is drawn for a phone too."""
    assert len(re.findall(r"\d", picture.alt)) > 1
    assert "nan" not in picture.alt
    for svg in (picture.wide, picture.narrow):
        plain = IMAGE.sub("", svg)
        assert {colour.lower() for colour in COLOUR.findall(plain)} <= TWINS
        assert not re.search(r"(fill|stroke): #", plain)
    assert picture.narrow not in ("", picture.wide)

"""The subjects of sentences, in the field's usual words; the book's own file says which page explains each.

A sentence, a part of the paper and a robot have a subject, and no page. The book maps subjects to its pages in
`report/subjects.toml`, and its build refuses a subject without a page.
"""

import enum
import functools
import tomllib
from pathlib import Path

from bench.base.provenance import ROOT

BOOK = ROOT / "report" / "subjects.toml"
"""The book's map. A package that is installed without the book lacks it."""


class SentenceSubject(enum.StrEnum):
    """What a sentence is about.

    Another subject needs a line here, and the line with its page in the book's map.
    """

    ARMS = "arms"
    ATAN2 = "atan2"
    CHOICE_OF_LAW = "choice-of-law"
    CLAIMS = "claims"
    COMPLIANCE = "compliance"
    COMPONENT_ORDER = "component-order"
    CONTACT = "contact"
    COST = "cost"
    DAMPING = "damping"
    DOUBLE_COVER = "double-cover"
    EULER_JACOBIAN = "euler-jacobian"
    FRAMES = "frames"
    GIMBAL_LOCK = "gimbal-lock"
    HALF_TURNS = "half-turns"
    JUDGE = "judge"
    LAWS = "laws"
    LOST_STARTS = "lost-starts"
    NOISE = "noise"
    ORIENTATION_ERROR = "orientation-error"
    PERFORMANCE = "performance"
    PLANT = "plant"
    POSITION_COMMANDS = "position-commands"
    REPRESENTATIONS = "representations"
    RESPONSES = "responses"
    ROBUSTNESS = "robustness"
    SINGULARITIES = "singularities"
    STIFFNESS = "stiffness"
    THREE_LAWS = "three-laws"
    UNITS = "units"
    UNWINDING = "unwinding"
    VELOCITY_COMMANDS = "velocity-commands"

    @classmethod
    def _missing_(cls, value: object) -> None:
        known = ", ".join(cls)
        name = str(value).upper().replace("-", "_")
        raise ValueError(
            f"subject '{value}' is unknown; known: {known} (cure: give one of these, or add the line "
            f'{name} = "{value}" to bench/findings/subjects.py)'
        )


@functools.cache
def read_pages(path: Path = BOOK) -> dict[str, str]:
    """Return the page of each subject, by the book's map; no page where the book does not lie beside the package."""
    if not path.is_file():
        return {}
    return tomllib.loads(path.read_text(encoding="utf-8"))


def find_reading(subject: SentenceSubject, path: Path = BOOK) -> str:
    """Return the page that explains a subject; where the book is missing, the subject itself."""
    return read_pages(path).get(subject, subject.value)


def describe_readings(path: Path = BOOK) -> str:
    """Say what the words are that `find_reading` returns, and where to read on."""
    if read_pages(path):
        return "pages of the book: report/pages, or make report"
    return "subjects that the book explains; the book is not beside this package"

"""Find and check the manipulators of tasks/arms.

<name>.xml is MJCF in one text (no meshes, no includes), <name>.py has a function xml() -> str that writes it. An arm is
six or seven hinges in one chain with a site "tool", a keyframe "home", one motor a joint whose ctrlrange is the rated
torque, and texts "title" and "source". Nothing else may act on it (viscous damping may), so that

    D qddot = tau - fg,   fg = qfrc_bias - qfrc_passive

is exact: the controller's model is perfect. `arm_check.py` holds a file to this. `variations.py` makes of it the arm as
it is, by numbers where they are known: <numeric> "hand" (m x y z Ixx Iyy Izz, of a massless body "tool"), "motors"
(least, usual and greatest inertia [kg m^2], if none is published), "torque-rate" [N m/s] and "gains" (kp and damping
ratio). At home the Jacobian's condition number is under 20, |cos beta| over a half, and gravity takes at most half of
the rated torques. An arm takes part in contact if its last body has a site "wrist". A folder is read at the time of the
call, and what was made of a text is kept by the text, not by the name.
"""

from __future__ import annotations

import re
import types
from functools import lru_cache
from pathlib import Path

from tasks.arm_model import Arm
from tasks.errors import BadArm, UnknownName

ARMS = Path(__file__).parent / "arms"
WORD = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def arm_names(folder: Path = ARMS) -> list[str]:
    """Names of all arms, sorted: of the files as they lie there, unread, so a broken one is among them."""
    return sorted(_files(folder))


def arm(name: str, folder: Path = ARMS) -> Arm:
    """Return the arm of this name; BadArm says what is wrong with its file."""
    files = _files(folder)
    if name not in files:
        raise UnknownName(
            f"arm '{name}' is not in tasks/arms; known: {', '.join(sorted(files))} (use one, or add a file there)"
        )
    if len(files[name]) > 1:
        raise BadArm(f"arm '{name}' has several files, {' and '.join(path.name for path in files[name])} (keep one)")
    if not WORD.fullmatch(name):
        raise BadArm(f"arm '{name}': its file name is no word of a-z, 0-9 and _ (rename it, as in my_arm.xml)")
    path = files[name][0]
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise BadArm(f"arm '{name}': {path.name} cannot be read ({error}) (save it as UTF-8 text)") from error
    return _checked(name, _xml_of(name, path.name, text) if path.suffix == ".py" else text)


def arms(folder: Path = ARMS) -> dict[str, Arm | BadArm]:
    """Every arm by name; of a broken file its refusal."""
    found: dict[str, Arm | BadArm] = {}
    for name in arm_names(folder):
        try:
            found[name] = arm(name, folder)
        except BadArm as refusal:
            found[name] = refusal
    return found


def _files(folder: Path) -> dict[str, list[Path]]:
    """{name: its files}; a package's own __init__.py is none."""
    found: dict[str, list[Path]] = {}
    for path in sorted(folder.iterdir()):
        if path.suffix in (".xml", ".py") and not path.name.startswith("_") and path.is_file():
            found.setdefault(path.stem.replace("_", "-"), []).append(path)
    return found


@lru_cache(maxsize=64)
def _xml_of(name: str, file: str, text: str) -> str:
    """Return what xml() of a Python file returns; run from its text, because Python's own cache goes by the clock."""
    module = types.ModuleType(f"tasks.arms.{Path(file).stem}")
    try:
        exec(compile(text, file, "exec"), module.__dict__)
        written = module.xml()
    except (Exception, SystemExit) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise BadArm(f"arm '{name}': xml() of {file} does not work ({reason}) (correct the file)") from error
    if not isinstance(written, str):
        raise BadArm(f"arm '{name}': xml() of {file} returns {type(written).__name__} (return the MJCF text, a str)")
    return written


@lru_cache(maxsize=64)
def _checked(name: str, xml: str) -> Arm:
    from tasks.arm_check import checked  # MuJoCo takes a moment to import; listing names must not

    return checked(name, xml)

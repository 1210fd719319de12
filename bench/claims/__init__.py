"""The paper's claims, C01 to C27: each sentence with a criterion fixed before the results, and its verdict.

One file for each part of the paper; a file with a constant CLAIMS is found by being here.

    verdict.py               what a claim, a verdict and its evidence are
    rotation_matrix.py       C01 to C05
    linearized_euler.py      C06 to C08
    feedback_linearized.py   C09 to C11
    costs.py                 C12, C17
    representations.py       C13 to C16
    later.py                 C18 to C27
"""

import functools
import importlib
import pkgutil

from bench.claims.verdict import Claim

MAIN_ENGINE = "ideal-rk4"
CHECK_ENGINES = ("ideal-held", "native")
RULE = (
    f"Engine {MAIN_ENGINE}, the paper's continuous system (2.6)-(2.7), decides. A claim about episodes is asked of "
    f"{' and '.join(CHECK_ENGINES)} too where they have rows: if one gives another word, 'holds' becomes 'holds "
    "with a correction' and the evidence says so; other words stay. A claim about which the tables hold no row is "
    "an error."
)
"""What is common to all criteria."""


@functools.cache
def known() -> dict[str, Claim]:
    """Id -> Claim, in the order of the ids."""
    modules = [importlib.import_module(f"{__name__}.{info.name}") for info in pkgutil.iter_modules(__path__)]
    found = [claim for module in modules for claim in getattr(module, "CLAIMS", ())]
    return {claim.id: claim for claim in sorted(found, key=lambda claim: claim.id)}

"""Compiled code kept on disk: a law taken from there is that law, whatever else the process has loaded."""

import json
import os
import subprocess
import sys

import pytest

LAWS = ("linearized-euler/zyx-euler", "linearized-euler-literal/zyx-euler")
"""One stabilizes the goal, the other leaves it; their compiled functions have the same names."""

ANGLES = """
import json, sys
from bench.law.contender import Gains
from bench.law.contenders.registry import find_contender
from bench.engines.episode import FINAL_ANGLE, Settings
from bench.engines.simulate import run
from tasks import start_set
settings = Settings(Gains(), 1e-3, 500, 501, 1e6, 1e4, 1e-3, 1e-2)
said = {}
for name in sys.argv[1:]:
    rows = run("ideal-rk4", find_contender(name), "free-body", start_set("paper"), settings, ())
    said[name] = rows[:, FINAL_ANGLE].tolist()
print(json.dumps(said))
"""


def angles(cache, *laws):
    """Final angles of laws, in a process of their own."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache)}
    command = [sys.executable, "-c", ANGLES, *laws]
    return json.loads(subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout)


@pytest.mark.slow
def test_laws_compiled_by_two_processes_at_once_do_not_mix_in_a_third(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    at_once = [
        subprocess.Popen([sys.executable, "-c", ANGLES, law], env=environment, stdout=subprocess.PIPE, text=True)
        for law in LAWS
    ]
    alone = {}
    for process in at_once:
        alone |= json.loads(process.communicate()[0])
    assert angles(tmp_path, *LAWS) == alone
    assert angles(tmp_path, *reversed(LAWS)) == alone

"""The pytest plugin under a name that no other project has: the wheel puts this file beside `bench`.

A project's own `bench` hides ours, so that the plugin is loaded by its place and not by its name.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOM = HERE.parent if HERE.name == "installed" else HERE / "bench" / "audit"
"""The folder of the audit, in a checkout or among installed packages."""

spec: Any = importlib.util.spec_from_file_location("orientation_audit_hooks", ROOM / "plugin.py")
hooks = importlib.util.module_from_spec(spec)
spec.loader.exec_module(hooks)
pytest_addoption = hooks.pytest_addoption
pytest_collection_modifyitems = hooks.pytest_collection_modifyitems

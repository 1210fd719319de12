"""Laws exported to Python, loaded here and asked on NumPy's arrays."""

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np

from bench.export.languages.python import module
from bench.export.subject import Subject
from support.exported import KP, KV


def loaded(subject: Subject, folder: Path) -> ModuleType:
    """The exported module."""
    path = folder / f"{subject.identifier}.py"
    path.write_text(module(subject), encoding="utf-8")
    spec = importlib.util.spec_from_file_location(subject.identifier, path)
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def asked(subject: Subject, rows: np.ndarray) -> list:
    """R, omega, R_d, gains, and a memory if it needs one, of such rows as `states` has."""
    by_rows = (*rows.shape[:-1], 3, 3)
    given = [rows[..., :9].reshape(by_rows), rows[..., 9:12], rows[..., 12:21].reshape(by_rows), KP, KV]
    return given if subject.memory is None else [*given, rows[..., 21:]]


def answered(law: ModuleType, given: list) -> np.ndarray:
    """u, with the memory after it."""
    answer = law.command(*given)
    return np.concatenate(answer, axis=-1) if isinstance(answer, tuple) else answer

"""Is a run the same on every processor? Quick suites under settings that round as others do: results/settings.

Libraries choose their kernels by the processor: OpenBLAS those of its linear algebra, numpy its vectors, the C library
its sin and cos, the compiler its target. Variables make them choose as on another one. Each run is held against
results/reference, bit for bit and by the gate.
"""

import functools
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from bench.base.files import read_json, write_json
from bench.base.processes import module_command
from bench.base.provenance import ROOT, machine_key, read_provenance, rounded_on
from bench.experiments.tables.store import read
from bench.regression.rows import RULES, find_differences
from bench.studies.study import make_parser, make_parts

REFERENCE = ROOT / "results" / "reference"
STORED = ROOT / "results" / "settings" / "settings.json"

NO_VECTORS = "X86_V3 X86_V4 AVX512_ICL AVX512_SPR"

SETTINGS: dict[str, dict[str, str]] = {
    "as-it-is": {},
    "blas": {"OPENBLAS_CORETYPE": "Prescott"},
    "blas-haswell": {"OPENBLAS_CORETYPE": "Haswell"},
    "blas-zen": {"OPENBLAS_CORETYPE": "Zen"},
    "compiler": {"NUMBA_CPU_NAME": "x86-64", "NUMBA_CPU_FEATURES": "", "NPY_DISABLE_CPU_FEATURES": NO_VECTORS},
    "compiler-fma": {"NUMBA_CPU_NAME": "haswell", "NUMBA_CPU_FEATURES": ""},
    "c-library": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"},
}
"""What each is called, and the variables that make it."""


def measure(variables: dict[str, str]) -> dict:
    """Compare a quick suite under these variables with the reference."""
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as name:
        return _compare(variables, Path(name) / "run")


def _compare(variables: dict[str, str], folder: Path) -> dict:
    command = module_command("bench", "run", "--suite", "quick", "--out", str(folder))
    subprocess.run(command, env=os.environ | variables, check=True)
    return {
        "made_on": rounded_on(read_provenance(folder)),
        "gate": len(find_differences(REFERENCE, folder)),
        "tables": {table: _bits(read(REFERENCE, table), read(folder, table)) for table in RULES},
    }


def _bits(old: pd.DataFrame, new: pd.DataFrame) -> dict:
    """How many rows a table has, how many of them differ in any bit, and in how many the outcome does."""
    if old.shape != new.shape:
        return {"rows": len(old), "differ": max(len(old), len(new)), "outcomes": 0}
    unlike = {name: ~_same(old[name], new[name]) for name in old}
    outcomes = unlike.get("outcome", np.zeros(len(old), bool))
    return {"rows": len(old), "differ": int(np.any([*unlike.values()], axis=0).sum()), "outcomes": int(outcomes.sum())}


def _same(a: pd.Series, b: pd.Series) -> np.ndarray:
    if a.dtype.kind not in "iuf":
        return (a.astype(str) == b.astype(str)).to_numpy()
    return (a.to_numpy() == b.to_numpy()) | (a.isna() & b.isna()).to_numpy()


def main() -> None:
    """Run the study."""
    chosen = make_parser("settings", __doc__, SETTINGS, STORED).parse_args()
    parts = {name: functools.partial(measure, variables) for name, variables in SETTINGS.items()}
    made = make_parts(chosen.out, parts, chosen.only)
    for name, one in made.items():
        print(f"{name}: {one['gate']} differences for the gate; {one['tables']}")
    found = read_json(chosen.out) if chosen.out.is_file() else {}
    found[machine_key()] = found.get(machine_key(), {}) | made
    write_json(chosen.out, found)


if __name__ == "__main__":
    main()

"""Import every module of the benchmark but those that need an extra: what the base set-up must be able to do."""

import importlib
import pkgutil

import bench
import tasks

OF_EXTRAS = (
    "bench.studies.libraries",
    "bench.running.schedulers.cluster",
    "bench.findings.proofs.",
    "tasks.gymnasium_suite",
)

for package in (bench, tasks):
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.", onerror=lambda name: None):
        if not module.name.startswith(OF_EXTRAS) and not module.name.endswith("__main__"):
            importlib.import_module(module.name)

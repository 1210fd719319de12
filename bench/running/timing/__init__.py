"""Time per tick of every law and engine on this machine (`bench time`), as ratios to a reference kernel.

The same code timed twice on a shared machine differs by half and more; a ratio to something timed a moment before or
after does not. So everything is timed in one run, in passes: each pass samples the reference kernel and every measured
benchmark in a random order of its own, and a ratio is taken within a pass.

An interval says how sure the median of this run is, on a machine in this state. Three full runs, minutes apart on two
shared cores, agreed within 1 % for laws alone; beside three processes that kept both cores busy, some ideal loops were
up to 12 % slower, far outside their intervals.
"""

from bench.running.timing.apart import run_apart
from bench.running.timing.benchmarks import Progress
from bench.running.timing.rows import about, read, run, tables

__all__ = ["Progress", "about", "read", "run", "run_apart", "tables"]

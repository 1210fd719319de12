"""False alarms and power of the regression gate: `python -m bench.studies.gates`, half an hour.

same code     fifty comparisons of a checkout with itself, every law and engine timed, while other processes keep the
              machine busy: any verdict but "same" is a false alarm
planted       a law made slower by steps: which share of comparisons finds each step, by time and by instructions
faults        one fault at a time planted in a copy of the sources: is it caught, and is it named?

load       the busy neighbours
planting   copies of the sources with a fault in them
faults     what is planted, and the runs that must show it
power      the slower and slower law
same_code  the fifty comparisons
"""

from bench.tables.schema import RESULTS

FOLDER = RESULTS / "regress"
"""Where the study leaves its results: same_code.json, power.json, faults.json."""

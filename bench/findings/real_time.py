"""Say where results of laws in real time are, and by what limits they were made."""

from bench.experiments.tables.schema import RESULTS

STUDY = RESULTS / "real-time"
"""What `python -P -m bench.studies.real_time` keeps."""

PERIOD_S = 1e-3
"""Control period of the loops [s]."""

GREATEST = 4.0
"""Kv T up to which a limit is looked for; the greatest with any constant delay is 3.12."""

HALVINGS = 9
"""How often the interval from 0 to GREATEST is halved: a limit of Kv T is known to GREATEST / 2^HALVINGS."""

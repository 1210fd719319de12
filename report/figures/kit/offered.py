"""Files of a run that the site offers beside its pages."""

OFFERED_BYTES = 8_000_000
"""A larger file is named, not offered: the site stays small enough to be mailed or put on a stick."""

SITE_DATA = "../data"
"""Seen from a page in pages/; report/build.py copies there what pages link to."""

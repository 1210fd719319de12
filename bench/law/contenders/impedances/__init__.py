"""Impedances, one file each with a constant IMPEDANCE; a file dropped here is found (see `bench.law.kinds`)."""

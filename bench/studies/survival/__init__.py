"""Runs that are killed, damaged or given laws that lie: programs that the tests start."""

"""Runs of laws that lie: a program that the tests start."""

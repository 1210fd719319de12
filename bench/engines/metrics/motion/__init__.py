"""Columns measured along an episode, by theme: each file holds one METRIC, or several METRICS.

An `update` is compiled into the loop; `finish` is plain Python. A file dropped here is found.
"""

"""Metrics of contact by theme: each file holds one METRIC, or several METRICS. A file dropped here is found."""

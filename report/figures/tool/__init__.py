"""The benchmark itself: history, regressions, clusters, survival."""

"""The benchmark itself: history and regressions."""

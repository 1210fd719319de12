"""What several files of tests share: states, starts, buffers, small runs and studies' helpers."""

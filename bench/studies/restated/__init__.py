"""The error block of each restated controller, built from its own source and compared with the kernel."""

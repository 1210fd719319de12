"""MuJoCo stepped from compiled code: its C functions, and steps whose errors come back as a number."""

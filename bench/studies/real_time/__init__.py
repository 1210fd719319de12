"""A controller in C++ and a simulated arm, each in a process of its own, in real time."""

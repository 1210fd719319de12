"""A controller in C++ and an arm in MuJoCo, each in a process of its own, in real time over shared memory."""

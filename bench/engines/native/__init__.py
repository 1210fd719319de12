"""MuJoCo stepped from compiled code: the dm_control loop, tick for tick and bit for bit.

free_body.py  the rotational system      arm.py  manipulators      libmujoco.py  the C functions
"""

"""dm_control's own loop with the plain Python law: slow, and the truth the compiled engines must reproduce.

free_body.py  the rotational system      arm.py  manipulators
"""

"""the function does not return.

effect: the control loop stops, and the motors keep the last command
cure: use no lock and no unlimited loop; compute the rotation between the two orientations in closed form
"""

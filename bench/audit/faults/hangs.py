"""the function does not return.

effect: the control loop stops, and its motors keep the last command
cure: use no lock and no unlimited iteration; the rotation between two orientations has a closed form
"""

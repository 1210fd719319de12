"""it does not return.

effect: the control loop stops, and its motors keep the last command
cure: no lock and no iteration without a bound: the rotation between two orientations has a closed form
"""

"""the function ends the process.

effect: the controller stops, and its motors get no command or keep the last command
cure: return an error for every pair of orientations, without an exit and without access beyond the end of an array
"""

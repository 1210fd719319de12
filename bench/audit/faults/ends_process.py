"""it ends the process.

effect: the controller is gone, and its motors get no command or keep the last one
cure: return an error for every pair of orientations: no exit, and no access beyond an array
"""

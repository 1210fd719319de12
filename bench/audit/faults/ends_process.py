"""the function ends the process.

effect: the controller stops, and the motors get no command or keep the last command
cure: return an orientation error for every pair of orientations; do not exit, and do not access memory beyond the end
  of an array
"""

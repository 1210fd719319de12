"""What stands between a velocity law and the robot, one file each, with one constant LIMITER. The file is the word."""

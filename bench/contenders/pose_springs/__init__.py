"""Springs of position and orientation, one file each, with one constant POSE_SPRING. The file is the word."""

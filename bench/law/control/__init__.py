"""Contenders put to work: the torques of an arm, and its controllers in contact."""

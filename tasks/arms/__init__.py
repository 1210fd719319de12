"""The arms: one mesh-free MJCF file each, `<name>.xml`, or `<name>.py` with xml() -> str. See tasks/arm.py."""

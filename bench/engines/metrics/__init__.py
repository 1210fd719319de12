"""What is measured: along an episode (motion/), and of a hand in contact (contact/)."""

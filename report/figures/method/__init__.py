"""Engines, steps, inventory, and where the numbers come from."""

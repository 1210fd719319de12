"""How all figures look, and what a page shows beside drawings."""

"""Single responses, and how long laws take to settle."""

"""A card for each law, and two laws beside each other."""

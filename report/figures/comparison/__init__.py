"""All laws side by side, and the new one among them."""

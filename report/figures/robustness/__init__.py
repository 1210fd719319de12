"""Laws along the axes of trouble."""

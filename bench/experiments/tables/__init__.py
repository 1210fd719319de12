"""Tables of results: their columns, how they are kept and read, what may be said of them."""

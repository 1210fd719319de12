"""Laws as code for another controller: translated from their one source, with test vectors."""

"""What the results say: the paper's claims, which law to use, closed forms."""

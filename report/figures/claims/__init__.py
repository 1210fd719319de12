"""The paper's claims judged, and its errata."""

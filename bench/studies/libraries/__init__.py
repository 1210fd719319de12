"""What robot libraries return as an orientation error, all at the same turns: python -P -m bench.studies.libraries."""

"""Languages that laws are exported to, one file each."""

"""Which law to use."""

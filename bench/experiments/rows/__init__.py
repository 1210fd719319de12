"""From numbers to rows: what the experiments make of what engines give back; with the engines imported at the top."""

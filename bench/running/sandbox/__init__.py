"""Units of users' laws: `sandbox` asks for their rows, `server` makes them in a process of the law's own."""

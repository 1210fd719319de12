"""Directed start sets of the free body that findings count together."""

AT_REST = ("half-turn", "poles", "wraps", "box")
"""Starts at rest whose goal is the identity: points of SO(3) alone."""

DIRECTED = (*AT_REST, "tumbling", "goals")
"""All sets but the uniform one and the paper's three examples."""

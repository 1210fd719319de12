"""Laws on arms: outcomes, Jacobians, costs, wrong models."""

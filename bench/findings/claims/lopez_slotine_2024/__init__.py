"""Claims of Lopez and Slotine 2024, LS01 to LS10, judged by the same rules as the claims of Murphy.

Brett T. Lopez and Jean-Jacques Slotine, Quaternion Sliding Variables in Manipulator Control, arXiv:2412.18921.
`attitude` has the claims; the motions that they look at are probes (`bench.experiments.probes.sliding`).
"""

WHAT_WE_READ = """
    We read the abstract, section 1 and the first lines of section 2 of arXiv:2412.18921, and a public summary of the
    paper. We also read the abstract and the first lines of section I of the earlier paper of the same authors,
    arXiv:2011.03648. We could not read the theorems, the proofs, the torque law, the simulations and the list of
    references. The sliding variable that we test, s = ω - λ sgn(η) ε, is from memory of the earlier paper,
    and we derived the command from it again. If the theorems use another variable, the verdicts on LS01 to LS06 are
    verdicts on our variable.
    """
"""What the verdicts rest on."""

"""What `show` says of a run in at most 40 lines of 80 columns, by what the run holds.

whole      the paper's three laws and what came since, its Jacobians, compliance, conclusions, the answer
some laws  the laws of the run beside each other
parts      arms, contact or robustness alone
"""

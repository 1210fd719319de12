"""Questions that users of robot libraries asked in public, each as a case that runs: symptom, cause, cure.

A question is one file with one constant QUESTION. Nobody's code runs here: what a thread describes is restated in a few
lines, measured over a range, and measured again with the cure.
"""

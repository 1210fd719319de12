"""Why a law does what it does: a sentence for each thing found of it, with the state that shows it and its page.

sentences.py    what the command field says (rows of command-field.parquet)
outcomes.py     what its episodes say: starts lost, the perturbation that breaks it first
nearest.py      the laws of the reference that pull and settle most alike
"""

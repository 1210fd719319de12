"""Laws as code for another controller: translated from their one source, with test vectors.

entries    what an export offers: orientation error, angular acceleration, torque; sprung: springs, laws with a state
subject    what is exported, by its word: a regulator, coordinates, an impedance or a spring
program    the functions that a law calls, with every name resolved
types      the kinds of expressions; reading infers them
braces     the writer for languages with braces; layout: lines and comments
heading    the heading of every file
vectors    test vectors
language   the record of a language; languages/ has one file each
wheel      the audit and all laws in Python as a package of their own
browser    all laws, the plant and the judge as one script for the live page
"""

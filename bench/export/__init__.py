"""Laws as code for somebody else's controller: translated from their one source, with test vectors.

program    the functions that a law calls, with every name resolved
types      what each expression is
entries    what an export offers: command, error, torque; frames; matrices and quaternions
subject    a regulator, coordinates or an impedance by its word
vectors    questions and our own answers; shaken: what another library's last bits may make of them
heading    what a file says first
braces     what languages with braces share; c_core: C and C++
masks      branches as masks, for arrays; flow: which variables they change
lanes      what an export to Python runs on: its text goes into each file
language   the record of a language; languages/ has one file each
"""

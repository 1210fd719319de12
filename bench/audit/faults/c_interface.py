"""the C function does not write exactly three doubles to its third argument.

effect: the controller reads numbers that were never written, or the function overwrites memory behind the array e
cure: declare void f(const double R[9], const double R_d[9], double e[3]), and write e[0], e[1] and e[2] only
"""

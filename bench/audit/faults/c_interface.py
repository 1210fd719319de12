"""another C interface than three doubles after two orientations.

effect: the controller reads an error that was never written, or what lies behind it in memory is overwritten
cure: void f(const double R[9], const double R_d[9], double e[3]): doubles, the error last, e[0] to e[2] and no more
"""

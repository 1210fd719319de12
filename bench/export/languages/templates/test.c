#include <stdio.h>

static int inexact = 0;

/* Bit for bit, or else within a tolerance: compilers that fuse products with sums change last digits. */
static int is_wrong(const double *found, const double *expected, int count, double tolerance) {
    double size = 0.0;
    int at, is_off = 0, wrong = 0;
    for (at = 0; at < count; at++) size = fmax(size, fabs(expected[at]));
    for (at = 0; at < count; at++) {
        if (!(fabs(found[at] - expected[at]) <= tolerance)) is_off = 1;
        if (!(fabs(found[at] - expected[at]) <= tolerance + CLOSE * size)) wrong = 1;
    }
    inexact += is_off && !wrong;
    return wrong;
}
FUNCTIONS
int main(void) {
    int wrong = 0;
CALLS
    printf("NAME: %d of COUNT vectors wrong\n", wrong);
    if (inexact) printf("%d answers are right to CLOSE; bit for bit: -ffp-contract=off, no -march\n", inexact);
    return wrong != 0;
}

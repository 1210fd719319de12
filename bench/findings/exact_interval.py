"""The exact interval of a share: without SciPy, whose special functions take a third of a second to import."""

import functools
import math
import sys

from bench.experiments.tables.statistics import TAIL


@functools.cache
def exact_interval(count: int, of: int) -> tuple[float, float]:
    """Return the exact 95 % interval of a share k of n (C. Clopper, E. Pearson, Biometrika 26, 1934).

    The lower end is the share at which k or more of n happen with the probability TAIL, and 0 where k = 0. The upper
    end is the share at which k or fewer happen with it, and 1 where k = n: n - k or more do not happen then.
    """
    low = _share_at_tail(count, of) if count > 0 else 0.0
    high = 1.0 - _share_at_tail(of - count, of) if count < of else 1.0
    return low, high


STEP = 1e-11
"""Step of the logarithm of a share at which Newton's method stops: it leaves the square of this. Rounding makes steps
of 4e-13 with ten million starts."""


def _share_at_tail(count: int, of: int) -> float:
    """Return the share p at which at least k > 0 of n happen with the probability TAIL.

    P(p) = b(k) (1 + r_k + r_k r_k+1 + ...), b the binomial probability and r_j = (n - j)/(j + 1) p/(1 - p) the ratio of
    two that follow one another. With S the sum in brackets, d log P / d log p = k/S. S grows with p, so log P is
    concave in log p, and Newton's method converges from every start; from k/(n + 1) all r_j are below 1.

    Limitations: rounding leaves 1e-16 log n! of the share, relatively: 1e-8 with ten million starts.
    """
    choose = math.lgamma(of + 1) - math.lgamma(count + 1) - math.lgamma(of - count + 1)
    log_share = math.log(count / (of + 1))
    step = math.inf
    while abs(step) > STEP:
        share = math.exp(log_share)
        odds = share / (1.0 - share)
        total = term = 1.0
        j = count
        while term > sys.float_info.epsilon * total:
            term *= (of - j) / (j + 1) * odds
            total += term
            j += 1
        log_first = choose + count * log_share + (of - count) * math.log1p(-share)
        step = (math.log(TAIL) - log_first - math.log(total)) * total / count
        log_share += step
    return math.exp(log_share)

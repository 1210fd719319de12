"""When a law counts as slower: beyond chance, by more than a tenth, and twice.

Rounds of base and head alternate, so that a slow moment of the machine meets both. Two conditions must hold together:
the Mann-Whitney test of the rounds rejects "not slower" at P, and the median ratio of neighbouring rounds is beyond
RATIO. The first keeps noise out; the second what is real but of no account, such as code that came to lie elsewhere in
memory. A second run, of the suspects alone and in new processes, must find the same, or the verdict is "same".

Fails: misses a law that got slower by less than a tenth. Counting its instructions does not.
"""

import numpy as np
from scipy.stats import mannwhitneyu

from bench.regression.revisions.comparison import FASTER, SAME, SLOWER, Timed
from bench.timing.ratios import ratio

P = 0.002
"""Of thirty laws and no change, one in seventeen comparisons has a p below this by chance; RATIO must agree."""

RATIO = 1.10


def judge(base: np.ndarray, head: np.ndarray) -> Timed:
    """The verdict of one run.

    Args:
        base, head: one time a round each, in the same unit, in the order in which they were taken.
    """
    middle = ratio(head, base)
    slower = float(mannwhitneyu(head, base, alternative="greater").pvalue)
    faster = float(mannwhitneyu(head, base, alternative="less").pvalue)
    if slower < P and middle.median > RATIO:
        verdict = SLOWER
    elif faster < P and middle.median < 1.0 / RATIO:
        verdict = FASTER
    else:
        verdict = SAME
    return Timed(*middle, min(slower, faster), len(base), verdict)


def confirmed(first: Timed, second: Timed) -> Timed:
    """The verdict of two runs: the first's if the second says so too, else "same"; the numbers are the second's.

    The first run of many picks what chance made largest; the second has no such choice, so its ratio is the honest one.
    """
    agrees = second.verdict == first.verdict
    return second._replace(verdict=first.verdict if agrees else SAME, confirmed=agrees)

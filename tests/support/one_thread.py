"""Matrices with one thread, as `bench` has it; import it before NumPy, which reads the variable when it is imported.

Threads of OpenBLAS wait at full speed: on two cores a logarithm of a 3 x 3 matrix took seven times the processor time.
"""

import os

from bench.__main__ import SETTINGS

BLAS = "OPENBLAS_NUM_THREADS"
os.environ.setdefault(BLAS, SETTINGS[BLAS])

"""Small dense kernels on buffers, of any element type: float64, or counting scalars in an object array.

A buffer may be larger than what is used of it; sizes are passed. Nothing is allocated. A singular matrix ends in
numbers that are not finite, and those that are not finite in any number, but never in an exception or an endless loop.
"""
# ruff: noqa: F401  the face of the folder

from bench.law.linalg.cholesky import exceeds, factor, solve_factored, solve_lower, solve_upper
from bench.law.linalg.elimination import determinant, solve
from bench.law.linalg.products import dot_rows, gram, gram_transposed, multiply, multiply_transposed
from bench.law.linalg.rotations import orthogonalize

"""The dense kernels against numpy.linalg, on matrices of every condition and rank; floats, counted, compiled alike."""

import numpy as np
import pytest
import sympy
from support.bits import EPS
from support.buffers import buffer, matrices, symmetric

from bench.law import linalg
from bench.law.linalg.cholesky import MARGIN
from bench.law.linalg.rotations import SWEEPS

SHAPES = [(6, 6), (6, 7), (7, 6), (7, 7), (3, 5), (2, 2), (1, 1)]
SQUARES = [3, 4, 5, 6, 7]
UNUSABLE = ("nan", "inf")
B = np.array([0.3, -1.2, 0.7, 2.0, -0.4, 0.9, 1.1])


def norm(A) -> float:
    return float(np.linalg.norm(A))


def matrices_of(rows, n):
    return matrices(rows, n) if n > 3 else {f"random-{i}": matrices(7, 7)[f"random-{i}"][:rows, :n] for i in range(8)}


def test_pivots_are_found_among_numbers_whose_squares_are_zero():
    A = 1e-200 * np.array([[1e-17, 1.0], [1.0, 1.0]])
    x = np.array([1e-200, 2e-200])
    linalg.solve(A.copy(), x, 2)
    np.testing.assert_allclose(x, [1.0, 1.0], rtol=0.0, atol=2 * EPS)


@pytest.mark.parametrize("n", SQUARES)
@pytest.mark.parametrize("word", ["zero", "zero-column", "equal-columns", "nan"])
def test_solution_of_a_singular_matrix_is_not_finite_and_its_determinant_is_zero(word, n):
    x = buffer(B[:n])
    A = np.ones((n, n)) if word == "equal-columns" else matrices(n, n)[word]
    with np.errstate(all="ignore"):
        linalg.solve(buffer(A), x, n)
    assert not np.isfinite(x[:n]).all()
    assert word == "nan" or linalg.determinant(buffer(A), np.zeros(7), n) == 0.0


@pytest.mark.parametrize("n", [2, *SQUARES])
def test_determinant_is_the_exact_one_of_integers(n):
    draw = np.random.default_rng(n)
    for _ in range(10):
        A = draw.integers(-9, 10, (n, n))
        exact = int(sympy.Matrix(A.tolist()).det())
        found = linalg.determinant(buffer(A), np.zeros(7), n)
        # the determinant of a matrix 1.5 n^3 growth EPS |A| away: n |A|^(n-1) times that bounds the change
        allowed = 6 * n**3 * EPS * max(1.0, abs(exact) * np.linalg.cond(A)) if exact else n**4 * EPS * norm(A) ** n
        assert abs(found - exact) <= allowed


@pytest.mark.parametrize("n", SQUARES)
def test_factor_is_numpys_reads_the_lower_half_only_and_solves_within_the_condition(n):
    for word, S in symmetric(n).items():
        if word in UNUSABLE or word == "large":
            continue
        L, x, condition = buffer(np.where(np.tri(n), S, np.nan)), buffer(B[:n]), np.linalg.cond(S)
        linalg.factor(L, n)
        theirs = np.linalg.cholesky(S)
        # |L - L'| <= n^2 EPS |L| cond(S) (Sun 1992), n^2 EPS the backward error of either
        allowed = 2 * n**2 * EPS * norm(theirs) * condition
        found = np.tril(L[:n, :n], -1) + np.diag(1.0 / np.diag(L[:n, :n]))
        np.testing.assert_allclose(found, theirs, rtol=0.0, atol=allowed, err_msg=word)
        linalg.solve_factored(L, x, n)
        solved = np.linalg.solve(S, B[:n])
        # Higham 2002, theorem 10.4: |dS| <= 4 n (3 n + 1) EPS/2 |S|, and as much again for theirs
        assert norm(x[:n] - solved) <= 4 * n * (3 * n + 1) * EPS * condition * norm(solved), word


@pytest.mark.parametrize("n", SQUARES)
def test_least_eigenvalue_exceeds_a_bound_only_if_it_is_surely_above(n):
    draw = np.random.default_rng(n)
    told = []
    for largest in (1.0, 10.0, 1e6):
        for least in (0.0, 1e-9, 1e-3):
            for beyond in (-1.0, -1e-3, -1e-9, 0.0, 0.5, 0.999, 1.001, 2.0, 10.0):
                Q, _ = np.linalg.qr(draw.normal(size=(n, n)))
                others = np.geomspace(0.1 * largest, largest, n - 1)
                # `beyond` margins above the bound, whose own part of the sum is worked in
                smallest = (least + beyond * MARGIN * others.sum()) / (1.0 - beyond * MARGIN)
                S = buffer((Q * [smallest, *others]) @ Q.T)
                found = linalg.exceeds(S, least, np.zeros((7, 7)), n)
                assert found == (beyond > 1.0), (largest, least, beyond)
                told.append(found)
    assert any(told)
    with np.errstate(all="ignore"):
        assert not any(linalg.exceeds(buffer(symmetric(n)[word]), 0.0, np.zeros((7, 7)), n) for word in UNUSABLE)


def turned(A, b):
    rows, n = A.shape
    held, beside = buffer(A), buffer(b)
    sweeps = linalg.orthogonalize(held, beside, rows, n)
    return held[:rows, :n], beside[:rows], sweeps


def rounding(rows, sweeps) -> float:
    """Each row is rotated rows - 1 times a sweep, each time with an error of up to 4 EPS of the two rows."""
    return 4 * EPS * (rows - 1) * sweeps + EPS


@pytest.mark.parametrize(("rows", "n"), SHAPES)
def test_orthogonalized_rows_are_orthogonal_turned_from_the_given_ones_and_as_long_as_numpys_singular_values(rows, n):
    for word, A in matrices_of(rows, n).items():
        if word in UNUSABLE:
            continue
        found, beside, sweeps = turned(A, B[:rows])
        assert sweeps < SWEEPS, word
        theirs = np.zeros(rows)
        theirs[: min(rows, n)] = np.linalg.svd(A, compute_uv=False)
        lengths, within = np.sort(np.linalg.norm(found, axis=1))[::-1], rounding(rows, sweeps) * norm(A)
        np.testing.assert_allclose(lengths, theirs, rtol=0.0, atol=within + 7 * EPS * norm(A), err_msg=word)
        products = found @ found.T
        # n EPS of two rows, or of a row that is zero to rounding, and the rounding of the product here
        assert np.abs(products - np.diag(np.diag(products))).max() <= 3 * n * EPS * norm(A) ** 2, word
        # U is orthogonal: A^T b is (U^T A)^T (U^T b)
        allowed = 2 * within * norm(B)
        np.testing.assert_allclose(found.T @ beside, A.T @ B[:rows], rtol=0.0, atol=allowed, err_msg=word)

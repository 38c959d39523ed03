# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of matrices that were damaged, and matrices that are no body's: each is refused in a sentence."""

import functools
import io
import unittest

import numpy as np

import palpate
from hard_files_test import OTHER, REFUSED, SAME, WRONG, Files, changed, outcomes, sentence
from support.matrices import dmig_text, harwell_boeing_text, mapping_text, market_text, truss


def imported(path):
    """The Green's functions of the truss, held by three corners, from a file."""
    _, surface, points = truss()
    mapping = path.with_name("k.mapping") if path.suffix == ".matrix" else None
    nodes = np.column_stack([np.arange(1, 8), points]) if mapping else points
    model = palpate.import_stiffness(surface, path, None if path.suffix == ".pch" else nodes,
                                     fixed=np.arange(6) > 2, mapping=mapping)
    return palpate.greens_functions(model)


def judge(path, whole):
    try:
        matrix = imported(path)
    except palpate.Error as error:
        return REFUSED if sentence(error, None) else WRONG
    if not np.isfinite(matrix).all():
        return WRONG
    return SAME if np.abs(matrix - whole).max() <= 1e-9 * np.abs(whole).max() else OTHER


class Matrices(Files):
    """The stiffness of 7 nodes in each format."""

    def setUp(self):
        super().setUp()
        stiffness, _, points = truss()
        (self.folder / "k.mapping").write_text(mapping_text(21))
        binary, text = io.BytesIO(), io.StringIO()
        np.save(binary, stiffness)
        np.savetxt(text, stiffness, fmt="%.17g", delimiter=",")
        self.files = {"k.npy": binary.getvalue(), "k.csv": text.getvalue().encode(),
                      "k.mtx": market_text(stiffness).encode(),
                      "k.matrix": harwell_boeing_text(stiffness).encode(),
                      "k.pch": dmig_text(stiffness, points).encode()}

    def told_of(self, mutants_of):
        told = b""
        for name, whole in self.files.items():
            path = self.folder / name
            path.write_bytes(whole)
            check = functools.partial(judge, whole=imported(path))
            self.assertEqual(check(path), SAME)
            told += outcomes(mutants_of(whole), path, check)
        return told

    def test_cut_off_anywhere(self):
        def cut(whole):
            return [whole[:n] for n in self.random.integers(0, len(whole) - 40, 60)]
        self.expect_safe(
            self.row("matrices as .npy, text, Matrix Market, Harwell-Boeing, DMIG, cut off at 60 places each",
                     "half a body"), self.told_of(cut))

    def test_with_bytes_changed_anywhere(self):
        def spoilt(whole):
            count = self.random.integers(1, 5, 100)
            return [changed(whole, self.random.integers(0, len(whole), n), self.random) for n in count]
        # A digit for another is another matrix, which may be a sound body's.
        self.expect_safe(
            self.row("matrices as .npy, text, Matrix Market, Harwell-Boeing, DMIG: one to four bytes "
                     "changed, 100 times each", "readers that crash, matrices that are not finite"),
            self.told_of(spoilt), others=None)

    def test_of_counts_that_no_file_holds(self):
        big = b"%%MatrixMarket matrix array real general\n200000000 200000000\n1\n"
        many = b"%%MatrixMarket matrix coordinate real general\n99999999 99999999 99999999\n1 1 1\n"
        numpy = b"\x93NUMPY\x01\x00" + bytes([80, 0]) + (
            b"{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296)}").ljust(80)
        told = b""
        for name, content in (("k.mtx", big), ("k.mtx", many), ("k.npy", numpy)):
            (self.folder / name).write_bytes(content)
            told += outcomes([content], self.folder / name, functools.partial(judge, whole=None))
        self.row("matrices of 10⁸ … 4·10⁹ rows in a few bytes", "all memory").expect_count(
            "of them refused", told.count(REFUSED), 3)

    def test_that_are_no_bodys(self):
        stiffness, surface, points = truss()
        fixed = np.arange(6) > 2
        compliance = np.linalg.inv(stiffness[:9, :9] + 1e4 * np.eye(9))
        swapped = np.r_[3:6, 0:3, 6:21]
        for name, danger, matrix, options, words in (
                ("a loose body's stiffness without a support", "an inverse of rounding errors",
                 stiffness, dict(fixed=None), "leaves the body free to move (translation along"),
                ("its nodes in another order", "a body that resists turning as a whole",
                 stiffness[np.ix_(swapped, swapped)], dict(), "its nodes are not where the surface has them"),
                ("its rows by component", "the same",
                 stiffness.reshape(7, 3, 7, 3).transpose(1, 0, 3, 2).reshape(21, 21), dict(),
                 "the rows of the stiffness are in another order"),
                ("a spring of negative stiffness inside", "energy from nothing",
                 stiffness - 9e5 * np.diag(np.r_[np.zeros(18), np.ones(3)]), dict(),
                 "does not hold row 19 (node 7, x)")):
            with self.assertRaises(palpate.Error) as caught:
                palpate.import_stiffness(surface, matrix, points, **{"fixed": fixed, **options})
            self.row(name, danger).expect_said(str(caught.exception), words)
        with self.assertRaises(palpate.Error) as caught:
            palpate.import_compliance(surface, compliance - 2e-5 * np.eye(9), points[:3], fixed=fixed)
        self.row("a compliance with negative eigenvalues", "forces that win energy").expect_said(
            str(caught.exception), "has a negative eigenvalue")


if __name__ == "__main__":
    unittest.main()

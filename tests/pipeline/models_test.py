# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The four models of data/, and what James & Pai 2001 say of such models."""

import unittest

import numpy as np

import palpate
from support.surfaces import points_of, triangles_of

# Vertices at each level, and free vertices at the level of Tables 2 and 3 of the paper.
COUNTS = {"nodule": ((34, 130, 514), 1, 89), "kidney": ((22, 82, 322), 2, 217),
          "spatula": ((35, 152, 620), 2, 559), "banana_seat": ((36, 138, 546), 2, 245)}
GENUS = {"nodule": 0, "kidney": 0, "spatula": 3, "banana_seat": 0}


def stiffness_at(model, point, **mask):
    """The 3 by 3 stiffness of a contact, column by column."""
    return np.column_stack([
        palpate.array(palpate.press(model, point, displacement=direction, **mask), "ContactForce")[0]
        for direction in np.eye(3)])


def mean_edge(surface):
    corners = points_of(surface)[triangles_of(surface)]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean()


class Counts(unittest.TestCase):
    def test_are_those_of_the_paper(self):
        for name, (counts, level, free) in COUNTS.items():
            coarse = palpate.read(palpate.example(name))
            surfaces = [palpate.refine(coarse, levels) for levels in range(3)]
            self.assertEqual(tuple(s.GetNumberOfPoints() for s in surfaces), counts, name)
            types = palpate.array(surfaces[level], "BoundaryType")
            self.assertEqual((types == 0).sum(), free, name)
            euler = coarse.GetNumberOfPoints() - coarse.GetNumberOfCells() / 2
            self.assertEqual(1 - euler / 2, GENUS[name], name)

    def test_are_in_metres_with_a_material(self):
        for name in COUNTS:
            surface = palpate.read(palpate.example(name))
            size = np.ptp(points_of(surface), axis=0).max()
            self.assertTrue(0.02 < size < 0.5, (name, size))
            self.assertGreater(palpate.array(surface, "YoungsModulus")[0], 1e3)


class Stiffness(unittest.TestCase):
    def test_is_symmetric_positive_definite_at_every_vertex_of_every_model(self):
        for name, (_, level, _) in COUNTS.items():
            model = palpate.precompute(palpate.refine(palpate.read(palpate.example(name)), level),
                                       None, None)
            for edges in (None, 2):
                field = palpate.stiffness(model, radius_in_edges=edges)
                k = palpate.array(field, "Stiffness").reshape(-1, 3, 3)
                skew = np.linalg.norm(k - k.transpose(0, 2, 1), axis=(1, 2))
                self.assertLess((skew / np.linalg.norm(k, axis=(1, 2))).max(), 1e-12)
                self.assertGreater(np.linalg.eigvalsh(k).min(), 0)

    def test_of_a_single_vertex_falls_with_refinement_and_under_a_mask_it_settles(self):
        # Table 1 of the paper: the top vertex; the mask's radius is the coarsest mean edge length.
        coarse = palpate.read(palpate.example("nodule"))
        top, radius = points_of(coarse)[np.argmax(points_of(coarse)[:, 2])], mean_edge(coarse)
        single, masked = [], []
        for levels in range(4):
            surface = palpate.refine(coarse, levels)
            top = points_of(surface)[np.argmax(points_of(surface)[:, 2])]
            near = np.linalg.norm(points_of(surface) - top, axis=1) <= radius
            columns = np.flatnonzero(near & (palpate.array(surface, "BoundaryType") == 0))
            model = palpate.precompute(surface, None, None, columns=columns)
            single.append(np.linalg.norm(stiffness_at(model, top)))
            masked.append(np.linalg.norm(stiffness_at(model, top, radius=radius)))
        self.assertGreater(single[0], 5 * single[2])
        self.assertLess(abs(masked[2] / masked[0] - 1), 0.2)
        self.assertLess(abs(masked[3] / masked[2] - 1), 0.03)


if __name__ == "__main__":
    unittest.main()

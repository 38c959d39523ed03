# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""vtkStiffnessArtifacts and vtkIsotropicRemeshing, their functions and `palpate remesh`."""

import functools
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import palpate
from support.surfaces import PROGRAM, points_of, sphere_model


@functools.lru_cache
def kidney(level):
    return palpate.precompute(palpate.refine(palpate.read(palpate.example("kidney")), level - 1),
                              None, None)


class Artifacts(unittest.TestCase):
    def setUp(self):
        self.model = kidney(3)
        self.free = palpate.array(self.model, "BoundaryType") == 0

    def test_the_kidneys_single_vertices_show_their_areas_and_masks_do_not(self):
        for level in (3, 4):  # the paper's 322 vertices, and 1282
            found = palpate.stiffness_artifacts(kidney(level), radius_in_edges=2)
            single, masked = palpate.array(found, "ArtifactAreaCorrelation")[0]
            self.assertGreater(single, 0.8)
            self.assertLess(abs(masked), 0.2)
            single, masked = palpate.array(found, "ArtifactVariation")[0]
            self.assertLess(masked, 0.8 * single)

    def test_of_masks_clear_of_the_support_vary_less_than_single_vertices_at_a_fixed_radius(self):
        # At the support finer meshes show more of the body's own rise, with or without masks.
        found = palpate.stiffness_artifacts(kidney(4), 0.016)
        clear = (palpate.array(kidney(4), "BoundaryType") == 0) & (
            palpate.array(found, "MaskSupportShare") == 0)
        area = palpate.array(found, "VertexArea")[clear]

        def variation(name):
            ratio = 1 + palpate.array(found, name)[clear]
            mean = np.average(ratio, weights=area)
            return np.average((ratio - mean)**2, weights=area)**0.5 / mean

        self.assertLess(variation("StiffnessArtifact"), 0.7 * variation("SingleVertexArtifact"))

    def test_says_all_that_the_stiffness_says_and_the_same(self):
        found = palpate.stiffness_artifacts(self.model, 0.016, "hertzian", measure="mean")
        plain = palpate.stiffness(self.model, 0.016, "hertzian", measure="mean")
        for name in ("Stiffness", "StiffnessNorm", "HapticRatio", "MaskSupportShare"):
            np.testing.assert_array_equal(palpate.array(found, name), palpate.array(plain, name))
        single = palpate.array(palpate.stiffness(self.model), "StiffnessNorm")
        np.testing.assert_allclose(
            palpate.array(found, "SingleVertexStiffnessNorm")[self.free], single[self.free], 1e-14)

    def test_principal_vectors_compose_the_stiffness_and_point_outwards(self):
        found = palpate.stiffness_artifacts(self.model, radius_in_edges=2)
        composed, lengths = 0, []
        for k in "123":
            vector = palpate.array(found, "PrincipalStiffness" + k)
            length = np.linalg.norm(vector, axis=1)
            self.assertEqual(length[~self.free].max(), 0)  # nothing is drawn at the support
            lengths.append(length[self.free])
            composed = composed + np.einsum("vi,vj->vij", vector[self.free], vector[self.free]) / (
                lengths[-1][:, None, None])
        stiffness = palpate.array(found, "Stiffness").reshape(-1, 3, 3)[self.free]
        self.assertLess(abs(composed - stiffness).max(), 1e-10 * abs(stiffness).max())
        self.assertTrue((lengths[0] >= lengths[1]).all() and (lengths[1] >= lengths[2]).all())
        np.testing.assert_allclose(palpate.array(found, "StiffnessCondition")[self.free],
                                   lengths[0] / lengths[2], 1e-10)

    def test_the_haptic_stiffness_is_nowhere_above_the_rigid_one(self):
        found = palpate.stiffness_artifacts(self.model, radius_in_edges=2, rigid_stiffness=150)
        norms = np.linalg.norm(palpate.array(found, "HapticStiffness"), axis=1)
        rigid = 150 * 3**0.5  # |K^R|_F
        self.assertLess(norms.max(), rigid * (1 + 1e-12))
        self.assertGreater(palpate.array(found, "StiffnessNorm").max(), rigid)

    def test_the_smooth_part_times_the_artefact_is_the_field(self):
        found = palpate.stiffness_artifacts(self.model, radius_in_edges=1)
        product = palpate.array(found, "SmoothStiffnessNorm") * (
            1 + palpate.array(found, "StiffnessArtifact"))
        np.testing.assert_allclose(product[self.free],
                                   palpate.array(found, "StiffnessNorm")[self.free], 1e-12)
        self.assertTrue(np.isnan(product[~self.free]).all())

    def test_masks_change_little_from_level_to_level_where_single_vertices_halve(self):
        changes = []
        for radius in (None, 0.016):
            finer = palpate.stiffness_artifacts(kidney(4), radius)
            found = palpate.stiffness_artifacts(self.model, radius, reference=finer)
            median, _, ninety_fifth, count = palpate.array(found, "StiffnessChangeMeasures")[0]
            self.assertGreater(count, 0.8 * self.free.sum())
            changes.append((median, ninety_fifth))
        self.assertGreater(changes[0][0], 0.7)   # h halves: nearly twice as stiff
        self.assertLess(abs(changes[1][0]), 0.01)
        self.assertLess(changes[1][1], 0.05)

    def test_against_itself_nothing_changes(self):
        plain = palpate.stiffness(self.model, radius_in_edges=2)
        found = palpate.stiffness_artifacts(self.model, radius_in_edges=2, reference=plain)
        change = palpate.array(found, "StiffnessChange")
        self.assertLess(np.nanmax(abs(change)), 1e-9)
        again = palpate.stiffness_artifacts(found, radius_in_edges=2)
        self.assertFalse(again.GetPointData().HasArray("StiffnessChange"))

    def test_refuses_in_a_sentence(self):
        for sentence, arguments in (
                ("smoothing length", {"smoothing_length": 50}),
                ("must be above 0", {"smoothing_length": -1}),
                ("must be above 0", {"smoothing_length": 0}),
                ("compute the reference's stiffness first", {"reference": kidney(3)}),
                ("same body", {"reference": palpate.stiffness(sphere_model(2))})):
            with self.assertRaisesRegex(palpate.Error, sentence):
                palpate.stiffness_artifacts(self.model, radius_in_edges=2, **arguments)


class Remeshing(unittest.TestCase):
    def setUp(self):
        self.surface = palpate.refine(palpate.read(palpate.example("kidney")), 3)

    def test_makes_the_edges_even_and_keeps_support_and_material(self):
        even = palpate.remesh(self.surface, 0.007)
        area = [palpate.array(palpate.stiffness(palpate.precompute(s, None, None), 0.02), "VertexArea")
                for s in (palpate.refine(palpate.read(palpate.example("kidney")), 2), even)]
        self.assertLess(area[1].std() / area[1].mean(), area[0].std() / area[0].mean())
        self.assertAlmostEqual(area[1].sum() / area[0].sum(), 1, delta=0.05)
        for name in ("YoungsModulus", "PoissonRatio"):
            self.assertEqual(palpate.array(even, name)[0], palpate.array(self.surface, name)[0])
        # Held where the old one is: the lowest half of z.
        for surface in (even, self.surface):
            z, fixed = points_of(surface)[:, 2], palpate.array(surface, "BoundaryType") == 1
            self.assertGreater(z[~fixed].mean(), z[fixed].mean())
        share = [palpate.array(s, "BoundaryType").mean() for s in (even, self.surface)]
        self.assertAlmostEqual(*share, delta=0.1)

    def test_drops_what_belongs_to_the_old_mesh(self):
        even = palpate.remesh(palpate.stiffness(kidney(3), radius_in_edges=2), 0.01)
        for name in ("GreensFunctions", "MeshFingerprint"):
            self.assertFalse(even.GetFieldData().HasArray(name))
        self.assertFalse(even.GetPointData().HasArray("Stiffness"))

    def test_of_the_program_writes_the_mesh_or_one_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "even.vtp"
            done = subprocess.run([PROGRAM, "remesh", palpate.example("kidney"), out,
                                   "--edge-length", "0.01"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(palpate.read(str(out)).GetNumberOfPoints(), 100)
            out.unlink()
            for length in ("5", "1e-9"):
                done = subprocess.run([PROGRAM, "remesh", palpate.example("kidney"), out,
                                       "--edge-length", length], capture_output=True, text=True)
                self.assertGreater(done.returncode, 0)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertFalse(out.exists())

    def test_refuses_in_a_sentence(self):
        for edge in (-1, 0, 7, 1e-7, float("inf")):
            with self.assertRaisesRegex(palpate.Error, "edge"):
                palpate.remesh(self.surface, edge)
        with self.assertRaisesRegex(palpate.Error, "iterations"):
            palpate.remesh(self.surface, iterations=0)


if __name__ == "__main__":
    unittest.main()

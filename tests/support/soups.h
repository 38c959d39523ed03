// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "support/shapes.h"

namespace palpate::test {

/// The corner (0,0,0), (1,0,0), (0,1,0), (0,0,1): volume 1/6, area (3 + sqrt 3) / 2.
Shape tetrahedron();

/// Two pyramids of height 1 over one regular polygon of radius 1; vertices 0 (above) and 1 (below)
/// are the tips, each in `valence` triangles.
Shape bipyramid(int valence);

/// A unit sphere around a spherical cavity: sound, the cavity's triangles point inwards.
Shape hollowSphere(int levels, double cavityRadius);

/// A block whose waist is pinched to nothing: two tetrahedra that share vertex 0.
Shape twoConesAtAPoint();

/// Two unit cubes that share the edge from (1,1,0) to (1,1,1).
Shape twoCubesAtAnEdge();

/// A unit cube whose top centre is pulled out through the base.
Shape cubeWithSpikeThroughItsBase();

/// A strip of 2 `count` triangles with half a turn in it: open and one-sided.
Shape moebiusStrip(int count);

/// A closed one-sided surface: each edge belongs to two triangles.
Shape kleinBottle(int around, int along);

Shape withVertex(const Shape& shape, const Eigen::Vector3d& x);
Shape withTriangle(const Shape& shape, const Eigen::Vector3i& triangle);
Shape withoutTriangle(const Shape& shape, int triangle);
Shape withTriangleFlipped(const Shape& shape, int triangle);
/// Each triangle has three vertices of its own, as in an STL file.
Shape tornApart(const Shape& shape);
/// The same surface, vertices and triangles renumbered at random, triangles' corners rotated.
Shape renumbered(const Shape& shape, unsigned seed = 1);

double signedVolume(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);
/// #V - #E + #F of a closed surface.
int eulerCharacteristic(const Eigen::Matrix3Xi& triangles);

}  // namespace palpate::test

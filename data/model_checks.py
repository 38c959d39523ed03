# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a control mesh has to satisfy at every level of its Loop hierarchy.

Throughout, ``points`` is n by 3 (metres), ``faces`` m by 3 vertex numbers (counterclockwise seen from outside)
and ``fixed`` n booleans (displacement given).
"""

from dataclasses import dataclass

import numpy as np

# Relative slack in the intersection tests, far above rounding (1e-16) and far below any feature (1e-3): a line
# counts as parallel to a triangle below the first, and as meeting it up to the second outside its sides.
PARALLEL = 1e-12
OUTSIDE = 1e-9


@dataclass
class Expectation:
    """Counts a model has to meet at levels 1, 2, 3, and the smallest angle (degrees) to accept at level 3."""

    genus: int
    vertices: tuple
    paper_level: int
    paper_free: int
    smallest_angle: float


def check(name, mesh, expected):
    """Print a line of measures a level; raise ValueError if the mesh is not sound or not as expected."""

    def demand(truth, complaint):
        if not truth:
            raise ValueError(f"{name}, level {level}: {complaint}")

    points, faces, fixed = mesh.points, mesh.faces, mesh.fixed
    for level, vertices in enumerate(expected.vertices, start=1):
        if level > 1:
            points, faces, fixed = loop_subdivide(points, faces, fixed)
        free, angle = np.count_nonzero(~fixed), smallest_angle(points, faces)
        wall, edge = thickness(points, faces), mean_edge_length(points, faces)
        print(f"{name:12} level {level}: {len(points):4} vertices ({free:3} free), {len(faces):4} faces, "
              f"smallest angle {angle:4.1f}°, thinnest wall {1e3 * wall.min():4.1f} mm, "
              f"mean edge {1e3 * edge:4.1f} mm, size {np.round(100 * np.ptp(points, axis=0), 1)} cm")
        demand(genus(faces, len(points)) == expected.genus, f"the genus is not {expected.genus}")
        demand(volume(points, faces) > 0, "the faces look inward")
        demand(len(points) == vertices, f"{vertices} vertices expected")
        demand(level != expected.paper_level or free == expected.paper_free, f"{expected.paper_free} free expected")
        demand(fixed[faces].all(axis=1).any(), "no whole face is fixed")
        demand(intersection_count(points, faces) == 0, "the surface meets itself")
    demand(angle >= expected.smallest_angle, f"an angle is below {expected.smallest_angle}°")


def edge_table(faces):
    """Edges (e by 2, smaller vertex number first), and per face those of its sides 01, 12, 20 (m by 3)."""
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, side_edges = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    return edges, side_edges.reshape(-1, 3)


def loop_subdivide(points, faces, fixed):
    """One step of Loop's scheme [Loop 1987] on a closed mesh; old vertices keep their numbers and types.

    A new vertex is fixed exactly if both ends of its edge are.
    """
    edges, face_edges = edge_table(faces)
    neighbour_sum = np.zeros_like(points)
    np.add.at(neighbour_sum, edges, points[edges[:, ::-1]])
    valence = np.bincount(edges.ravel())[:, None]
    beta = (5 / 8 - (3 / 8 + np.cos(2 * np.pi / valence) / 4) ** 2) / valence
    old_points = (1 - valence * beta) * points + beta * neighbour_sum

    # 3/8 of both ends and 1/8 of both opposite corners: the corners of both faces and the ends once more, over 8.
    around = points[edges].sum(axis=1)
    np.add.at(around, face_edges, points[faces].sum(axis=1)[:, None, :])

    a, b, c = faces.T
    ab, bc, ca = face_edges.T + len(points)
    quarters = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    new_faces = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return np.concatenate([old_points, around / 8]), new_faces, np.concatenate([fixed, fixed[edges].all(axis=1)])


def genus(faces, vertex_count):
    """Genus of a surface; ValueError if it is not closed, oriented, manifold and in one piece."""
    following = [{} for _ in range(vertex_count)]  # per vertex, each neighbour's next one counterclockwise
    for face in faces.tolist():
        for vertex, first, second in (face, face[1:] + face[:1], face[2:] + face[:2]):
            if first in following[vertex]:
                raise ValueError(f"two faces have the side from {vertex} to {first}")
            following[vertex][first] = second
    for vertex, after in enumerate(following):
        walked = [next(iter(after), None)]
        while after.get(walked[-1]) not in (None, walked[0]):
            walked.append(after[walked[-1]])
        if len(walked) != len(after) or walked[-1] not in after:
            raise ValueError(f"the faces around vertex {vertex} are not one closed fan")
    reached, waiting = {0}, [0]
    while waiting:
        new = set(following[waiting.pop()]) - reached
        reached |= new
        waiting += new
    if len(reached) != vertex_count:
        raise ValueError("the surface has several pieces")
    euler = vertex_count - len(faces) // 2  # a closed surface has 3/2 as many edges as faces
    return (2 - euler) // 2


def volume(points, faces):
    """Enclosed volume, m³; positive if the faces look outward."""
    a, b, c = points[faces].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def mean_edge_length(points, faces):
    """Mean edge length, m."""
    edges, _ = edge_table(faces)
    return np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean()


def smallest_angle(points, faces):
    """Smallest angle of all triangles, degrees."""
    corners = points[faces]
    ahead = np.roll(corners, -1, axis=1) - corners
    back = np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(ahead, back), axis=2)
    return np.degrees(np.arctan2(sine, (ahead * back).sum(axis=2)).min())


def meetings(origins, directions, triangles):
    """t (rays by triangles) where origin + t direction meets a triangle [Möller and Trumbore 1997], else NaN."""
    a = triangles[:, 0]
    side1, side2 = triangles[:, 1] - a, triangles[:, 2] - a
    p = np.cross(directions[:, None], side2)
    determinant = (p * side1).sum(axis=2)
    size = np.linalg.norm(side1, axis=1) * np.linalg.norm(side2, axis=1)
    determinant[np.abs(determinant) < PARALLEL * size * np.linalg.norm(directions, axis=1)[:, None]] = np.nan
    offset = origins[:, None] - a
    q = np.cross(offset, side1)
    u = (offset * p).sum(axis=2) / determinant
    v = (q * directions[:, None]).sum(axis=2) / determinant
    inside = (u >= -OUTSIDE) & (v >= -OUTSIDE) & (u + v <= 1 + OUTSIDE)
    return np.where(inside, (q * side2).sum(axis=2) / determinant, np.nan)


def blocks(count, size=200):
    """The numbers below count in blocks small enough to try each against all triangles at once."""
    return np.array_split(np.arange(count), count // size + 1)


def intersection_count(points, faces):
    """Number of pairs of an edge and a triangle that share no vertex and yet meet."""
    edges, _ = edge_table(faces)
    count = 0
    for block in blocks(len(edges)):
        ends = points[edges[block]]
        t = meetings(ends[:, 0], ends[:, 1] - ends[:, 0], points[faces])
        apart = ~(edges[block][:, None, :, None] == faces[:, None, :]).any(axis=(2, 3))
        count += np.count_nonzero(apart & (t >= 0) & (t <= 1))
    return count


def thickness(points, faces):
    """Distance from each vertex along its inward normal to the opposite wall, m."""
    a, b, c = points[faces].transpose(1, 0, 2)
    inward = np.zeros_like(points)
    np.add.at(inward, faces, np.cross(c - a, b - a)[:, None, :])
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    depth = np.empty(len(points))
    for block in blocks(len(points)):
        t = meetings(points[block], inward[block], points[faces])
        own = (faces == block[:, None, None]).any(axis=2)
        depth[block] = np.nanmin(np.where(own | ~(t > 0), np.inf, t), axis=1)
    return depth

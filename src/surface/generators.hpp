// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made from a few numbers.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "surface/mesh.hpp"
#include "surface/pattern.hpp"

namespace luff::surface {

/// Parallelogram origin + s a + t b, 0 <= s, t <= 1; its normal is along a x b.
struct Rectangle {
  Vec3 origin = Vec3::Zero();  ///< [L]
  Vec3 a = Vec3::UnitX();      ///< first side [L]
  Vec3 b = Vec3::UnitY();      ///< second side [L]
  std::array<int, 2> divisions{1, 1};
  /// Growth of the spacing from one end of a side to the other, > 0; not with Pattern::Delaunay, which spreads evenly.
  std::array<double, 2> grading{1, 1};
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;  ///< Irregular: largest move of an inner vertex, in spacings, 0 <= d < 0.45
  unsigned seed = 1;           ///< Irregular, Delaunay: same seed, same mesh
};

/// Where a round surface lies. Angles about the axis are right-handed and start at `start`.
struct Frame {
  Vec3 centre = Vec3::Zero();  ///< [L]
  Vec3 axis = Vec3::UnitZ();   ///< of any length
  /// Direction of angle 0, of which the part normal to the axis counts; else the x axis, or y if that is the axis.
  std::optional<Vec3> start = {};
};

/// Part of a circle [degrees]; 360 from end to end is the whole, closed without a seam.
struct Sector {
  double from = 0;
  double to = 360;
};

/// Disk about the frame's centre; its normal is along the axis. Six sectors of triangles meet in the centre of a whole
/// disk, ring k has 6 k vertices; smaller disks have fewer sectors.
struct Disk {
  Frame frame = {};
  double radius = 1;  ///< [L]
  Sector angle = {};
  int rings = 4;
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;
  unsigned seed = 1;
};

/// Disk with a hole; its normal is along the axis.
struct Annulus {
  Frame frame = {};
  double inner_radius = 0.5;  ///< [L]
  double radius = 1;          ///< [L]
  Sector angle = {};
  std::array<int, 2> divisions{24, 4};  ///< around, across
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;
  unsigned seed = 1;
};

/// Lateral surface of a circular cylinder, from the frame's centre along the axis; its normal points away from the
/// axis.
struct Cylinder {
  Frame frame = {};
  double radius = 1;  ///< [L]
  double length = 1;  ///< [L]
  Sector angle = {};
  std::array<int, 2> divisions{24, 4};  ///< around, along the axis
  std::array<double, 2> grading{1, 1};  ///< as in Rectangle; none around a whole circle
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;
  unsigned seed = 1;
};

/// Zone of a sphere between two angles from the axis; its normal points away from the centre. With a pole in it, it is
/// made of rings about that pole, as a disk is; 0 to 180 of the whole circle is the closed sphere, the octahedron cut
/// finer. Without a pole it has rows and columns.
struct SphereCap {
  Frame frame = {};
  double radius = 1;                    ///< [L]
  Sector polar = {0, 90};               ///< angle from the axis, within 0 to 180 degrees
  Sector angle = {};                    ///< about the axis
  int rings = 4;                        ///< with a pole: from end to end
  std::array<int, 2> divisions{24, 4};  ///< without a pole: around, from the far end (polar.to) to the near one
  std::array<double, 2> grading{1, 1};  ///< without a pole, as in Cylinder
  Pattern pattern = Pattern::Diagonal;
  double displacement = 0.28;
  unsigned seed = 1;
};

using Shape = std::variant<Rectangle, Disk, Annulus, Cylinder, SphereCap>;

/// Vertices lie on the exact surface, those of the boundary on its edges; vertex (i, j) of rows and columns has number
/// i (divisions[1] + 1) + j. Edges that are there are named after what they are the ends of: a_min, a_max, b_min,
/// b_max; angle_min, angle_max; length_min, length_max; radius_min, radius_max; polar_min, polar_max (a centre or pole
/// is a vertex); boundary is all of them. \throws InputError for lengths that are not positive, sides that are
/// parallel, angles, displacements or numbers of divisions out of range, an axis without direction, a start along the
/// axis.
MarkedMesh make(const Shape& shape);

TriangleMesh rectangle(const Rectangle& shape);
TriangleMesh disk(const Disk& shape);
TriangleMesh annulus(const Annulus& shape);
TriangleMesh cylinder(const Cylinder& shape);
TriangleMesh sphere_cap(const SphereCap& shape);

/// Does the zone hold a pole, so that it is made of rings?
bool has_pole(const SphereCap& shape);

/// Turn by `degrees` about the line through `about` along `axis` (right-hand rule).
void rotate(TriangleMesh& mesh, const Vec3& axis, double degrees, const Vec3& about = Vec3::Zero());
/// The same; fields of vectors turn, too.
void rotate(MarkedMesh& marked, const Vec3& axis, double degrees, const Vec3& about = Vec3::Zero());
void translate(TriangleMesh& mesh, const Vec3& shift);
/// Stretch about the origin by a factor per axis, all positive.
void scale(TriangleMesh& mesh, const Vec3& factors);

}  // namespace luff::surface

// SPDX-License-Identifier: BSD-3-Clause
// The wetted surface of a shell whose thickness the flow sees: two faces, half the thickness off the middle surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "surface/marked_mesh.hpp"

namespace luff::simulation {

/// A vertex of the middle surface that stays on a plane of symmetry.
struct HeldNormal {
  int vertex = 0;
  int plane = 0;               ///< the same number for all vertices on one plane
  Vec3 normal = Vec3::Zero();  ///< of the plane, unit length
};

/// A closed surface around the middle surface: its + face, its - face and a rim that joins them along the boundary
/// edges, but not along those on planes of symmetry, which close it themselves. With the normal n = N/|N| of a vertex,
/// N the sum of the area vectors of its triangles,
///
///   x± = x ± (h/2) n,   v± = v ± (h/2) (I - n nᵀ) dN/dt / |N|,
///
/// and the middle of the rim moves with the edge. Forces on the skin are carried to the middle surface by the transpose
/// of what gives velocities: they do the same work there, and what shear does half a thickness off the middle surface
/// arrives as a moment. Vertices: those of the + face, of the - face, of the rim's middle; triangles: the + face, the
/// - face, the rim. Its normals point outwards, into the fluid.
class Skin {
 public:
  Skin(const surface::MarkedMesh& middle, double thickness, std::vector<HeldNormal> held);

  /// Of the middle surface.
  [[nodiscard]] int n_middle() const { return n_middle_; }
  [[nodiscard]] const surface::TriangleMesh& reference() const { return reference_; }
  /// Sets of the middle surface: its vertices and triangles on both faces, and the rim at its edges.
  [[nodiscard]] const surface::Marks& marks() const { return marks_; }

  /// Of the skin's vertices with the middle surface's at x.
  [[nodiscard]] std::vector<Vec3> positions(std::span<const Vec3> x) const;
  /// Of the skin's vertices with the middle surface's at x and rates v there: velocities, or accelerations without
  /// what the turning of the normals adds to them.
  [[nodiscard]] std::vector<Vec3> rates(std::span<const Vec3> x, std::span<const Vec3> v) const;
  /// Forces on the middle surface's vertices, at x, for forces on the skin's.
  [[nodiscard]] std::vector<Vec3> forces(std::span<const Vec3> x, std::span<const Vec3> on_skin) const;

 private:
  void make_rim(const surface::TriangleMesh& middle);
  void carry_marks(const surface::Marks& middle);
  [[nodiscard]] std::vector<Vec3> area_vectors(std::span<const Vec3> x) const;
  /// A field of the skin from that of the middle surface and what half a thickness out of it adds, times the half.
  [[nodiscard]] std::vector<Vec3> beside(std::span<const Vec3> middle, std::span<const Vec3> out) const;
  void keep_on_planes(std::vector<Vec3>& vectors) const;

  int n_middle_;
  double half_;  ///< of the thickness
  std::vector<HeldNormal> held_;
  std::vector<std::array<int, 3>> middle_;  ///< triangles
  std::vector<int> rim_;                    ///< vertices of the middle surface on boundary edges, ascending
  surface::TriangleMesh reference_;
  surface::Marks marks_;
};

}  // namespace luff::simulation

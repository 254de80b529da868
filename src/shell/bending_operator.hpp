// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a triangle from the vertices around it: the constant operator of the rotation-free element.
#pragma once

#include <string_view>
#include <vector>

#include "shell/images.hpp"
#include "shell/support.hpp"
#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// One vertex (or image of one) in the curvature of a triangle.
struct StencilEntry {
  int vertex;
  int image;  ///< index into BendingOperator::images, or -1 for the vertex itself
  Vec3 H;     ///< weights in (x_,11, x_,22, 2 x_,12) [1/L^2]
};

/// kappa_V = n . sum_i H_V^i y_i for every triangle; the first three entries are its corners, then come the
/// apices of its patch.
struct BendingOperator {
  Images images;
  std::vector<std::vector<StencilEntry>> stencils;
  /// Largest q = 1/sigma_min of a patch's quadratic fit: 1 for equilateral patches, 1/(machine epsilon) for six
  /// vertices on a conic or two that coincide (around a vertex of three triangles); 0 for hinges, which fit nothing.
  double worst_conic = 0;
  int worst_triangle = -1;
  /// Triangles without a quadratic of their own because q > 50, or because the condition of no moment at their free
  /// edges does not settle one: averaged slopes come from their neighbours alone, or from hinge angles where those have
  /// none either; patch quadratics become hinge angles.
  int n_replaced = 0;
};

/// How the curvature of a triangle is found (docs/numerics/shell.md).
///
/// | kind               | sees        | exact on quadratics | in equilibrium under constant moments |
/// |--------------------|-------------|---------------------|---------------------------------------|
/// | AveragedQuadratics | 12 vertices | yes                 | yes                                   |
/// | PatchQuadratic     | 6 vertices  | yes                 | on regular meshes                     |
/// | Hinge              | 6 vertices  | on regular meshes   | yes                                   |
///
/// Only the first converges to the right answer on every mesh.
enum class BendingKind {
  AveragedQuadratics,  ///< slopes at the mid-edges averaged between the quadratics of the two patches (ours)
  PatchQuadratic,      ///< second derivatives of the patch's own quadratic [stolarski_2013_rotation]
  Hinge                ///< angles between neighbours weighted by height [grinspun_2006_computing]
};

/// Curvature operator of every triangle. The bending `moduli` (shape only) weight the natural condition at free edges.
/// \throws InputError naming `shell` and the triangle where the mesh folds back on itself.
BendingOperator bending_operator(BendingKind kind, const surface::TriangleMesh& mesh, const surface::Topology& topology,
                                 const std::vector<MirrorEdge>& mirrors, const Mat3& moduli, std::string_view shell);

}  // namespace luff::shell

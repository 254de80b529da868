// SPDX-License-Identifier: BSD-3-Clause
// Surfaces through a flow: planes, and where a field has one value.
#pragma once

#include <span>

#include <mpi.h>

#include "output/snapshot.hpp"

namespace luff::output {

/// A structured block of points with fields by point, i fastest.
struct PointBlock {
  Index3 points{};           ///< along each index direction, two at least
  std::vector<Vec3> places;  ///< [L]
  std::vector<NamedField> fields;
};

/// The part of the plane through `point` that lies in the block, in triangles, with the block's fields, linear between
/// its points.
[[nodiscard]] SurfaceSnapshot cut_by_plane(const PointBlock& block, const Vec3& point, const Vec3& normal);

/// Where `values`, one per point, are equal to `value`.
[[nodiscard]] SurfaceSnapshot surface_of_value(const PointBlock& block, std::span<const float> values, double value);

/// The pieces of all ranks as one surface on the first rank of `comm`, in the order of ranks; empty on the others.
/// Fields by point only, the same and of single precision on every rank.  Collective.
[[nodiscard]] SurfaceSnapshot gathered(const SurfaceSnapshot& piece, MPI_Comm comm);

}  // namespace luff::output

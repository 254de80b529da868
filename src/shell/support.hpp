// SPDX-License-Identifier: BSD-3-Clause
// How a shell is held: which displacements are zero and which edges keep their slope.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// | kind     | displacement of the vertices        | slope of the boundary edges between them |
/// |----------|-------------------------------------|------------------------------------------|
/// | Clamped  | zero                                | that of the reference                    |
/// | Hinged   | zero                                | free (no moment)                         |
/// | Symmetry | zero along the plane's normal       | mirrored in the plane                    |
/// | Fixed    | chosen components zero              | free (no moment)                         |
/// Edges without a support are free: no force, no moment.
enum class SupportKind { Clamped, Hinged, Symmetry, Fixed };

struct Support {
  SupportKind kind = SupportKind::Clamped;
  std::vector<int> vertices{};
  /// Fixed: which of x, y, z are held.
  std::array<bool, 3> components{true, true, true};
  /// Symmetry: unit normal of the plane, along x, y or z; found from the edges when absent.
  std::optional<Vec3> normal{};
};

/// A boundary edge across which the shell is continued by its mirror image.
struct MirrorEdge {
  surface::TriangleEdge edge;
  Vec3 normal;  ///< of the mirror, unit
};

/// All supports of a shell together.
struct Constraints {
  std::vector<char> held;  ///< 3n flags in the interleaved layout: 1 = displacement zero
  std::vector<MirrorEdge> mirrors;
};

/// \throws InputError naming `shell` and the support (numbered from 1) when it selects nothing, cannot keep a slope or
/// is a symmetry whose plane is not normal to an axis.
Constraints constraints(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                        std::span<const Support> supports, std::string_view shell);

}  // namespace luff::shell

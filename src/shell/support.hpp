// SPDX-License-Identifier: BSD-3-Clause
// How a shell is held: which displacements are zero, prescribed or elastic, and which edges keep their slope.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shell/held.hpp"
#include "shell/motion.hpp"
#include "shell/springs.hpp"
#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// | kind     | displacement of the vertices        | slope of the boundary edges between them |
/// |----------|-------------------------------------|------------------------------------------|
/// | Clamped  | zero                                | that of the reference                    |
/// | Hinged   | zero                                | free (no moment)                         |
/// | Symmetry | zero along the plane's normal       | mirrored in the plane                    |
/// | Fixed    | chosen components zero              | free (no moment)                         |
/// | Elastic  | against springs                     | against springs, free without them       |
/// Edges without a support are free: no force, no moment. Clamped, hinged and fixed supports may move: their
/// displacement is then the motion's, and clamped edges turn with its rotation.
enum class SupportKind { Clamped, Hinged, Symmetry, Fixed, Elastic };

struct Support {
  SupportKind kind = SupportKind::Clamped;
  std::vector<int> vertices{};
  /// Fixed: which of x, y, z are held.
  std::array<bool, 3> components{true, true, true};
  /// Symmetry: normal of the plane, of any length; found from the edges when absent.
  std::optional<Vec3> normal{};
  /// Elastic: stiffness of all vertices together along x, y, z [M/T^2], shared like a point force.
  Vec3 stiffness = Vec3::Zero();
  /// Elastic: moment per length and angle on boundary edges that turn about their direction [M L/T^2 per rad].
  double turning_stiffness = 0;
  /// Clamped, hinged, fixed: where the vertices go; at rest when absent.
  std::optional<Motion> motion{};
};

/// A boundary edge across which the shell is continued by its mirror image.
struct MirrorEdge {
  surface::TriangleEdge edge;
  Vec3 normal;      ///< of the mirror in the reference, unit
  int motion = -1;  ///< that turns and carries the mirror, -1: none
};

/// All supports of a shell together.
struct Constraints {
  Held held;
  std::vector<MirrorEdge> mirrors;
  Springs springs;
};

/// \throws InputError naming `shell` and the support (numbered from 1) when it selects nothing, cannot keep a slope, is
/// a symmetry whose vertices are in no plane, or moves where another support does so too.
Constraints constraints(const surface::TriangleMesh& mesh, const surface::Topology& topology,
                        std::span<const Support> supports, std::string_view shell);

}  // namespace luff::shell

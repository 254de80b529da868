// SPDX-License-Identifier: BSD-3-Clause
// The reference area that belongs to each vertex.
#pragma once

#include <Eigen/Core>

#include "shell/shell.hpp"

namespace luff::shell {

/// A third of the reference area of the triangles at each vertex [L^2].
inline Eigen::VectorXd vertex_areas(const Shell& shell)
{
  const surface::TriangleMesh& mesh = shell.reference();
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (const int v : mesh.triangles[t])
      areas[v] += surface::area(mesh, t) / 3;
  return areas;
}

}  // namespace luff::shell

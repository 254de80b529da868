// SPDX-License-Identifier: BSD-3-Clause
// Meshes and shells that tests share.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "shell/shell.hpp"
#include "surface/generators.hpp"
#include "surface/selection.hpp"

namespace luff::test {

/// Random numbers in [-1, 1), the same in every run.
inline Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed)
{
  std::mt19937_64 engine(seed);
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i)
    v[i] = 2 * (static_cast<double>(engine() >> 11) * 0x1p-53) - 1;
  return v;
}

inline surface::TriangleMesh sheet(double length, double width, int n_length, int n_width,
                                   surface::Pattern pattern = surface::Pattern::Irregular, unsigned seed = 7)
{
  return surface::rectangle({.a = Vec3(length, 0, 0),
                             .b = Vec3(0, width, 0),
                             .divisions = {n_length, n_width},
                             .pattern = pattern,
                             .seed = seed});
}

/// A curved irregular sheet over [0, 1.2] x [0, 1.1]: bent along x, a parabola along y with a horizontal start.
inline surface::TriangleMesh curved_sheet(int n_length = 5, int n_width = 4)
{
  surface::TriangleMesh mesh = sheet(1.2, 1.1, n_length, n_width);
  for (Vec3& X : mesh.vertices)
    X = Vec3(std::sin(X.x()), X.y(), 1 - std::cos(X.x()) + 0.2 / 1.21 * X.y() * X.y());
  return mesh;
}

/// Vertices for which the predicate holds in the reference.
template <class Predicate>
std::vector<int> vertices_where(const surface::TriangleMesh& mesh, Predicate holds)
{
  std::vector<int> found;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (holds(mesh.vertices[v]))
      found.push_back(v);
  return found;
}

/// Vertices on the outline of a flat sheet [0, length] x [0, width].
inline std::vector<int> outline(const surface::TriangleMesh& mesh, double length, double width)
{
  return vertices_where(mesh,
                        [=](const Vec3& X) { return X.x() == 0 || X.y() == 0 || X.x() == length || X.y() == width; });
}

}  // namespace luff::test

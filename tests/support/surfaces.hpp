// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that geometric tests are made on, and ways to misplace them.
#pragma once

#include <map>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "surface/mesh.hpp"

namespace luff::test {

using surface::TriangleMesh;

/// Adds a surface to another; no vertex becomes one with those that are there.
inline void append(TriangleMesh& mesh, const TriangleMesh& other)
{
  const int first = mesh.n_vertices();
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/// The cube |x|, |y|, |z| <= 1, normals out.
inline TriangleMesh cube()
{
  TriangleMesh mesh;
  for (int v = 0; v < 8; ++v)
    mesh.vertices.emplace_back((v & 1) ? 1 : -1, (v & 2) ? 1 : -1, (v & 4) ? 1 : -1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The octahedron, each triangle split in four `levels` times, its vertices on the unit sphere, normals out.
inline TriangleMesh sphere(int levels)
{
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {1.0, -1.0})
      mesh.vertices.emplace_back(end * Vec3::Unit(axis));
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> midpoints;
    const auto midpoint = [&](int a, int b) {
      const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), mesh.n_vertices());
      if (is_new)
        mesh.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = midpoint(a, b);
      const int bc = midpoint(b, c);
      const int ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// The sheet z = 0, |x|, |y| <= 1, of n x n squares cut along alternating diagonals; normal along z.
inline TriangleMesh sheet(int n)
{
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.emplace_back(-1.0 + 2.0 * i / n, -1.0 + 2.0 * j / n, 0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = i + (n + 1) * j;
      const std::array<int, 4> corner{v, v + 1, v + n + 2, v + n + 1};
      const int s = (i + j) % 2;
      mesh.triangles.push_back({corner[s], corner[s + 1], corner[s + 2]});
      mesh.triangles.push_back({corner[s], corner[s + 2], corner[(s + 3) % 4]});
    }
  return mesh;
}

template <class Map>
TriangleMesh mapped(TriangleMesh mesh, Map map)
{
  for (Vec3& x : mesh.vertices)
    x = map(x);
  return mesh;
}

/// Numbers between -1 and 1, and turns about any axis by any angle.
class Chance {
 public:
  explicit Chance(unsigned seed) : bits_(seed) {}

  double number() { return between_(bits_); }
  Vec3 vector() { return {number(), number(), number()}; }
  int index(int n) { return std::uniform_int_distribution<int>(0, n - 1)(bits_); }
  Mat3 turn()
  {
    std::normal_distribution<double> normal;
    Eigen::Quaterniond q(normal(bits_), normal(bits_), normal(bits_), normal(bits_));
    return q.normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 bits_;
  std::uniform_real_distribution<double> between_{-1.0, 1.0};
};

}  // namespace luff::test

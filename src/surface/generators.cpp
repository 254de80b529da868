// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made from a few numbers.
#include "surface/generators.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/topology.hpp"

namespace luff::surface {

namespace {

/// Repeatable numbers, the same with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// Uniform in [-1, 1).
  double symmetric() { return 2 * (static_cast<double>(engine_() >> 11) * 0x1p-53) - 1; }

 private:
  std::mt19937_64 engine_;
};

void check(const Rectangle& shape)
{
  if (shape.divisions[0] < 1 || shape.divisions[1] < 1)
    fail_input("rectangle: divisions = [{}, {}] must both be at least 1", shape.divisions[0], shape.divisions[1]);
  if (!shape.origin.allFinite() || !shape.a.allFinite() || !shape.b.allFinite())
    fail_input("rectangle: origin, a and b must be finite numbers");
  // Below this sine of the angle between the sides the triangles have no usable area.
  constexpr double smallest_sine = 1e-6;
  if (!(shape.a.cross(shape.b).norm() > smallest_sine * shape.a.norm() * shape.b.norm()))
    fail_input("rectangle: sides a = [{}, {}, {}] and b = [{}, {}, {}] must be longer than zero and not parallel",
               shape.a.x(), shape.a.y(), shape.a.z(), shape.b.x(), shape.b.y(), shape.b.z());
  if (!(shape.displacement >= 0 && shape.displacement < 0.45))
    fail_input("rectangle: displacement = {} must be in [0, 0.45): beyond it triangles turn over", shape.displacement);
}

bool along_first_diagonal(Pattern pattern, int i, int j, Random& random)
{
  switch (pattern) {
    case Pattern::Diagonal:
      return true;
    case Pattern::Alternating:
      return (i + j) % 2 == 0;
    case Pattern::Irregular:
      return random.symmetric() > 0;
  }
  return true;
}

void place_vertices(const Rectangle& shape, Random& random, TriangleMesh& mesh)
{
  const auto [na, nb] = shape.divisions;
  for (int i = 0; i <= na; ++i)
    for (int j = 0; j <= nb; ++j) {
      double s = i, t = j;
      const bool inner = i > 0 && i < na && j > 0 && j < nb;
      if (inner && shape.pattern == Pattern::Irregular) {
        s += shape.displacement * random.symmetric();
        t += shape.displacement * random.symmetric();
      }
      mesh.vertices.push_back(shape.origin + s / na * shape.a + t / nb * shape.b);
    }
}

void cut_quadrilaterals(const Rectangle& shape, Random& random, TriangleMesh& mesh)
{
  const auto [na, nb] = shape.divisions;
  for (int i = 0; i < na; ++i)
    for (int j = 0; j < nb; ++j) {
      const int p = i * (nb + 1) + j, q = p + nb + 1, r = q + 1, s = p + 1;
      if (along_first_diagonal(shape.pattern, i, j, random)) {
        mesh.triangles.push_back({p, q, r});
        mesh.triangles.push_back({p, r, s});
      } else {
        mesh.triangles.push_back({p, q, s});
        mesh.triangles.push_back({q, r, s});
      }
    }
}

/// Of the angles at p and q over the edge ab: |..| sin(angle_p + angle_q), relative; negative where the edge must flip.
double sine_of_opposite_angles(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b)
{
  const Vec3 pa = a - p, pb = b - p, qa = a - q, qb = b - q;
  const double lengths = pa.norm() * pb.norm() * qa.norm() * qb.norm();
  return (pa.cross(pb).norm() * qa.dot(qb) + pa.dot(pb) * qa.cross(qb).norm()) / lengths;
}

/// Flip the edges whose opposite angles sum to more than pi [lawson_1977_software]; returns how many.
int flip_edges(TriangleMesh& mesh, const Vec3& normal)
{
  constexpr double round_off = 1e-9;
  const Topology neighbours = topology(mesh);
  std::vector<bool> touched(mesh.triangles.size(), false);
  int flips = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3 && !touched[t]; ++k) {
      const int u = neighbours.neighbour[t][k];
      if (u < 0 || touched[u])
        continue;
      const int p = mesh.triangles[t][k], q = mesh.triangles[u][neighbours.neighbour_edge[t][k]];
      const auto [a, b] = edge_vertices(mesh.triangles[t], k);
      const auto& x = mesh.vertices;
      const bool convex =
          area_vector(x[p], x[a], x[q]).dot(normal) > 0 && area_vector(x[p], x[q], x[b]).dot(normal) > 0;
      if (!convex || sine_of_opposite_angles(x[p], x[q], x[a], x[b]) > -round_off)
        continue;
      mesh.triangles[t] = {p, a, q};
      mesh.triangles[u] = {p, q, b};
      touched[t] = touched[u] = true;
      ++flips;
    }
  return flips;
}

}  // namespace

TriangleMesh rectangle(const Rectangle& shape)
{
  check(shape);
  TriangleMesh mesh;
  Random random(shape.seed);
  place_vertices(shape, random, mesh);
  cut_quadrilaterals(shape, random, mesh);
  if (shape.pattern == Pattern::Irregular)
    while (flip_edges(mesh, shape.a.cross(shape.b)) > 0) {
    }
  return mesh;
}

void rotate(TriangleMesh& mesh, const Vec3& axis, double degrees, const Vec3& about)
{
  if (!axis.allFinite() || !(axis.norm() > 0) || !std::isfinite(degrees))
    fail_input("rotate: axis = [{}, {}, {}] must have a length and angle = {} must be finite", axis.x(), axis.y(),
               axis.z(), degrees);
  const Eigen::AngleAxisd rotation(degrees * std::numbers::pi / 180, axis.normalized());
  for (Vec3& x : mesh.vertices)
    x = about + rotation * Vec3(x - about);
}

void translate(TriangleMesh& mesh, const Vec3& shift)
{
  for (Vec3& x : mesh.vertices)
    x += shift;
}

void scale(TriangleMesh& mesh, const Vec3& factors)
{
  if (!(factors.minCoeff() > 0) || !factors.allFinite())
    fail_input("scale: factors [{}, {}, {}] must be positive", factors.x(), factors.y(), factors.z());
  for (Vec3& x : mesh.vertices)
    x = x.cwiseProduct(factors);
}

}  // namespace luff::surface

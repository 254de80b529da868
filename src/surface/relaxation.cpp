// SPDX-License-Identifier: BSD-3-Clause
// Edge flips, random walks and Lloyd's iteration.
#include "surface/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/topology.hpp"

namespace luff::surface {

namespace {

/// Of the angles at p and q over the edge ab: |..| sin(angle_p + angle_q), relative; negative where the edge must flip.
double sine_of_opposite_angles(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b)
{
  const Vec3 pa = a - p, pb = b - p, qa = a - q, qb = b - q;
  const double lengths = pa.norm() * pb.norm() * qa.norm() * qb.norm();
  return (pa.cross(pb).norm() * qa.dot(qb) + pa.dot(pb) * qa.cross(qb).norm()) / lengths;
}

/// Flips edges in place and keeps track of the neighbours.
class Flipper {
 public:
  Flipper(TriangleMesh& mesh, const ParametricSurface& surface)
      : mesh_(mesh), surface_(surface), neighbours_(topology(mesh))
  {
  }

  void run()
  {
    std::vector<int> waiting;
    for (int t = mesh_.n_triangles() - 1; t >= 0; --t)
      waiting.push_back(t);
    // In a plane flipping ends by itself; on a curved surface this is sure to end it.
    for (long flips = 0, most = 100L * mesh_.n_triangles(); !waiting.empty() && flips < most;) {
      const int t = waiting.back();
      waiting.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int u = neighbours_.neighbour[t][k];
        if (u < 0 || !must_flip(t, k))
          continue;
        flip(t, k);
        ++flips;
        waiting.insert(waiting.end(), {u, t});
        break;
      }
    }
  }

 private:
  bool must_flip(int t, int k) const
  {
    constexpr double round_off = 1e-9;
    const int p = mesh_.triangles[t][k], q = opposite(t, k);
    const auto [a, b] = edge_vertices(mesh_.triangles[t], k);
    const auto& x = mesh_.vertices;
    if (sine_of_opposite_angles(x[p], x[q], x[a], x[b]) > -round_off)
      return false;
    const Vec3 normal = surface_.normal(0.5 * (x[a] + x[b]));
    const bool convex = area_vector(x[p], x[a], x[q]).dot(normal) > 0 && area_vector(x[p], x[q], x[b]).dot(normal) > 0;
    return convex && !are_joined(t, k, q);
  }

  /// Corner of the triangle across edge k.
  int opposite(int t, int k) const
  {
    return mesh_.triangles[neighbours_.neighbour[t][k]][neighbours_.neighbour_edge[t][k]];
  }

  /// Has corner k of triangle t an edge to q already? On a coarse closed mesh it may have, around the back.
  bool are_joined(int t, int k, int q) const
  {
    for (const int turn : {1, 2}) {
      int at = t, corner = k;
      do {
        const auto& triangle = mesh_.triangles[at];
        if (triangle[0] == q || triangle[1] == q || triangle[2] == q)
          return true;
        const int across = (corner + turn) % 3;
        const int next = neighbours_.neighbour[at][across];
        if (next < 0)
          break;
        corner = (neighbours_.neighbour_edge[at][across] + turn) % 3;
        at = next;
      } while (at != t);
    }
    return false;
  }

  /// Triangles (p, a, b) and (q, b, a) become (p, a, q) and (p, q, b).
  void flip(int t, int k)
  {
    const int u = neighbours_.neighbour[t][k], l = neighbours_.neighbour_edge[t][k];
    const int p = mesh_.triangles[t][k], q = mesh_.triangles[u][l];
    const auto [a, b] = edge_vertices(mesh_.triangles[t], k);
    const TriangleEdge pa = beyond(t, (k + 2) % 3), bp = beyond(t, (k + 1) % 3);
    const TriangleEdge aq = beyond(u, (l + 1) % 3), qb = beyond(u, (l + 2) % 3);
    mesh_.triangles[t] = {p, a, q};
    mesh_.triangles[u] = {p, q, b};
    link({t, 0}, aq);
    link({t, 1}, {u, 2});
    link({t, 2}, pa);
    link({u, 0}, qb);
    link({u, 1}, bp);
  }

  TriangleEdge beyond(int t, int k) const { return {neighbours_.neighbour[t][k], neighbours_.neighbour_edge[t][k]}; }

  void link(TriangleEdge one, TriangleEdge other)
  {
    neighbours_.neighbour[one.triangle][one.edge] = other.triangle;
    neighbours_.neighbour_edge[one.triangle][one.edge] = other.edge;
    if (other.triangle < 0)
      return;
    neighbours_.neighbour[other.triangle][other.edge] = one.triangle;
    neighbours_.neighbour_edge[other.triangle][other.edge] = one.edge;
  }

  TriangleMesh& mesh_;
  const ParametricSurface& surface_;
  Topology neighbours_;
};

/// Quality below which no vertex may move a triangle; one that is worse already may only get better.
constexpr double thinnest = 0.1;

/// Looks at the triangles of a vertex, and moves it while they stay sound.
class Mover {
 public:
  Mover(TriangleMesh& mesh, const ParametricSurface& surface) : mesh_(mesh), surface_(surface)
  {
    star_.resize(mesh.vertices.size());
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (const int v : mesh.triangles[t])
        star_[v].push_back(t);
  }

  /// Distance between vertices there, were they on a square grid.
  double spacing(int v) const { return std::sqrt(star_area(v) / 3); }

  double star_area(int v) const
  {
    double sum = 0;
    for (const int t : star_[v])
      sum += area(mesh_, t);
    return sum;
  }

  Vec3 star_centroid(int v) const
  {
    Vec3 sum = Vec3::Zero();
    for (const int t : star_[v])
      sum += area(mesh_, t) * centroid(mesh_, t);
    return sum / star_area(v);
  }

  /// Least quality 4 sqrt(3) area / (sum of squared sides), 1 for equilateral ones, negative if turned over, among a
  /// vertex's triangles.
  double quality(int v) const
  {
    const Vec3 normal = surface_.normal(mesh_.vertices[v]).normalized();
    double least = 1;
    for (const int t : star_[v]) {
      const auto& [i, j, k] = mesh_.triangles[t];
      const auto& x = mesh_.vertices;
      const double sides = (x[i] - x[j]).squaredNorm() + (x[j] - x[k]).squaredNorm() + (x[k] - x[i]).squaredNorm();
      least = std::min(least, 4 * std::numbers::sqrt3 * area_vector(x[i], x[j], x[k]).dot(normal) / sides);
    }
    return least;
  }

  /// To the point of the surface nearest to `target`, unless the quality of the vertex then falls below `least`.
  void move(int v, const Vec3& target, double least)
  {
    const Vec3 before = mesh_.vertices[v];
    mesh_.vertices[v] = surface_.nearest(target);
    if (!(quality(v) >= least))
      mesh_.vertices[v] = before;
  }

 private:
  TriangleMesh& mesh_;
  const ParametricSurface& surface_;
  std::vector<std::vector<int>> star_;
};

}  // namespace

void flip_to_delaunay(TriangleMesh& mesh, const ParametricSurface& surface)
{
  Flipper(mesh, surface).run();
}

namespace {

using Mask = std::vector<bool>;

/// Random walk of the vertices in `mobile`.
void scatter(TriangleMesh& mesh, const ParametricSurface& surface, const Mask& mobile, Random& random)
{
  constexpr int sweeps = 12;
  constexpr double step = 0.5;  // in spacings
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Mover mover(mesh, surface);
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (mobile[v])
        mover.move(v, mesh.vertices[v] + step * mover.spacing(v) * random.vector(),
                   std::min(thinnest, mover.quality(v)));
    flip_to_delaunay(mesh, surface);
  }
}

/// Lloyd's iteration with the vertex's patch in the place of its Voronoi cell [chen_2011_efficient]: every vertex goes
/// to the area-weighted mean of its triangles' centroids.
void relax(TriangleMesh& mesh, const ParametricSurface& surface, const Mask& mobile)
{
  constexpr int sweeps = 10;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Mover mover(mesh, surface);
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (mobile[v])
        mover.move(v, mover.star_centroid(v), std::min(thinnest, mover.quality(v)));
    flip_to_delaunay(mesh, surface);
  }
}

/// Quality below which a triangle is mended.
constexpr double poor = 0.72;

/// Moves vertices of poor triangles a little and keeps what is better: Lloyd's iteration leaves some of them near the
/// boundary, whose vertices don't move.
void mend(TriangleMesh& mesh, const ParametricSurface& surface, const Mask& mobile, Random& random)
{
  constexpr int sweeps = 6;
  constexpr int tries = 12;
  constexpr double step = 0.1;  // in spacings
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Mover mover(mesh, surface);
    for (int v = 0; v < mesh.n_vertices(); ++v)
      for (int i = 0; i < tries && mobile[v] && mover.quality(v) < poor; ++i)
        mover.move(v, mesh.vertices[v] + step * mover.spacing(v) * random.vector(), mover.quality(v));
    flip_to_delaunay(mesh, surface);
  }
}

/// Inner vertices with a poor triangle, and those up to two edges away.
Mask around_poor(TriangleMesh& mesh, const ParametricSurface& surface, const Mask& inner)
{
  constexpr int edges_away = 2;
  const Mover mover(mesh, surface);
  Mask chosen(mesh.vertices.size(), false);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    chosen[v] = inner[v] && mover.quality(v) < poor;
  for (int edge = 0; edge < edges_away; ++edge) {
    const Mask before = chosen;
    for (const auto& [i, j, k] : mesh.triangles)
      if (before[i] || before[j] || before[k])
        for (const int v : {i, j, k})
          chosen[v] = inner[v];
  }
  return chosen;
}

}  // namespace

void spread(TriangleMesh& mesh, const ParametricSurface& surface, const std::vector<bool>& inner, Random& random)
{
  constexpr int rounds = 10;
  Mask mobile = inner;
  for (int round = 0; round < rounds && std::find(mobile.begin(), mobile.end(), true) != mobile.end(); ++round) {
    scatter(mesh, surface, mobile, random);
    relax(mesh, surface, mobile);
    mend(mesh, surface, mobile, random);
    mobile = around_poor(mesh, surface, inner);
  }
}

}  // namespace luff::surface

// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/vertex_patches.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "grid/locate.hpp"
#include "surface/mesh.hpp"

namespace luff::immersed {

namespace {

/// Where weights end, in cells: a mesh as fine as the grid, and somewhat compressed, is left alone.
constexpr double reach = 0.9;
/// Moments of inertia below this part of the largest are those of a line about itself.
constexpr double slender = 1e-9;

/// Of the vertices below `count`: the others that share a triangle with them.
std::vector<std::vector<int>> neighbours(std::span<const std::array<int, 3>> triangles, int count)
{
  std::vector<std::vector<int>> around(count);
  for (const auto& triangle : triangles)
    for (const int v : triangle)
      for (const int w : triangle)
        if (v != w && v < count && std::ranges::find(around[v], w) == around[v].end())
          around[v].push_back(w);
  return around;
}

/// J^-1 on the space in which J does not vanish.
Mat3 pseudo_inverse(const Mat3& J)
{
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.compute(J);
  Vec3 inverse = Vec3::Zero();
  for (int m = 0; m < 3; ++m)
    if (eigen.eigenvalues()[m] > slender * eigen.eigenvalues()[2])
      inverse[m] = 1.0 / eigen.eigenvalues()[m];
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

VertexPatches::VertexPatches(std::span<const std::array<int, 3>> triangles, int count)
    : triangles_(triangles.begin(), triangles.end()), around_(neighbours(triangles, count))
{
}

void VertexPatches::update(const grid::Grid& grid, std::span<const Vec3> positions)
{
  patches_.clear();
  members_.clear();
  const int count = static_cast<int>(around_.size());
  const std::vector<grid::Standing> standings = grid::standings(grid, positions.first(count));
  std::vector<double> area;  // once there is a patch
  std::vector<int> seen_from(count, -1);
  for (int v = 0; v < count; ++v) {
    const grid::CellShape& cell = standings[v].cell;
    const Vec3 per_cell = cell.widths.cwiseInverse();
    std::vector<Member> members{{v, 1.0, Vec3::Zero()}};
    seen_from[v] = v;
    for (std::size_t m = 0; m < members.size(); ++m)  // outwards along edges, as far as they reach
      for (const int w : around_[members[m].vertex]) {
        if (seen_from[w] == v)
          continue;
        seen_from[w] = v;
        const double q = (cell.normals * (positions[w] - positions[v])).cwiseProduct(per_cell).norm();
        if (q < reach)
          members.push_back({w, 1.0 - q / reach, Vec3::Zero()});
      }
    if (members.size() == 1)
      continue;
    if (area.empty())
      area = areas(positions);
    for (Member& m : members)
      m.weight *= area[m.vertex];
    add_patch(v, members, positions);
  }
}

/// A third of the triangles around each vertex.
std::vector<double> VertexPatches::areas(std::span<const Vec3> x) const
{
  const int count = static_cast<int>(around_.size());
  std::vector<double> area(count, 0.0);
  for (const auto& [a, b, c] : triangles_)
    for (const int v : {a, b, c})
      if (v < count)
        area[v] += surface::area_vector(x[a], x[b], x[c]).norm() / 3.0;
  return area;
}

void VertexPatches::add_patch(int vertex, const std::vector<Member>& members, std::span<const Vec3> positions)
{
  double weight = 0.0;
  Vec3 centre = Vec3::Zero();  // from the vertex
  for (const Member& m : members) {
    weight += m.weight;
    centre += m.weight * (positions[m.vertex] - positions[vertex]);
  }
  centre /= weight;
  Patch patch{.vertex = vertex, .first = static_cast<int>(members_.size()), .arm = -centre, .inverse = Mat3::Zero()};
  Mat3 J = Mat3::Zero();
  for (const Member& m : members) {
    const Vec3 arm = positions[m.vertex] - positions[vertex] - centre;
    members_.push_back({m.vertex, m.weight / weight, arm});
    J += m.weight / weight * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  patch.last = static_cast<int>(members_.size());
  patch.inverse = pseudo_inverse(J);
  patches_.push_back(patch);
}

SheetLoads VertexPatches::spread(SheetLoads loads) const
{
  spread(loads.minus);
  spread(loads.plus);
  return loads;
}

void VertexPatches::spread(std::vector<Vec3>& forces) const
{
  std::vector<Vec3> from;
  for (const Patch& patch : patches_)
    from.push_back(std::exchange(forces[patch.vertex], Vec3::Zero()));
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Patch& patch = patches_[p];
    const Vec3 turn = patch.inverse * patch.arm.cross(from[p]);
    for (int m = patch.first; m < patch.last; ++m)
      forces[members_[m].vertex] += members_[m].weight * (from[p] + turn.cross(members_[m].arm));
  }
}

std::vector<Vec3> VertexPatches::seen(std::span<const Vec3> velocity) const
{
  std::vector<Vec3> result(velocity.begin(), velocity.end());
  for (const Patch& patch : patches_) {
    Vec3 mean = Vec3::Zero();
    Vec3 spin = Vec3::Zero();
    for (int m = patch.first; m < patch.last; ++m) {
      const Vec3 u = members_[m].weight * velocity[members_[m].vertex];
      mean += u;
      spin += members_[m].arm.cross(u);
    }
    result[patch.vertex] = mean + (patch.inverse * spin).cross(patch.arm);
  }
  return result;
}

}  // namespace luff::immersed

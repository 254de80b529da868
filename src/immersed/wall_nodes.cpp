// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/wall_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "immersed/cell_metric.hpp"
#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"
#include "surface/mesh.hpp"

namespace luff::immersed {

namespace {

enum Mark { LowFaceCut = 1, Node = 8, Donor = 16 };  // LowFaceCut << axis

/// Below this part of a cell's width a node counts as lying on the sheet, whose own normal then serves.
constexpr double on_sheet = 1e-8;
/// Donors that weigh less are left out.
constexpr double least_weight = 1e-10;

/// The direction of a vector in the space of indices, grad xi_a . n = S_a . n/V.
Vec3 index_direction(const grid::Grid& grid, const Index3& cell, const Vec3& n)
{
  Vec3 q;
  for (int a = 0; a < 3; ++a)
    q[a] = centre_area_vector(grid, a, cell).normalized().dot(n) / width_across(grid, a, cell);
  return q;
}

/// The hit nearest to the centre of a cut cell, on which of its links it lies, and the vector to it.
struct NearestHit {
  int hit = 0;
  int face = 0;
  int side = 0;
  Vec3 to_hit = Vec3::Zero();
};

NearestHit nearest_hit(const grid::Grid& grid, const CutLinks& links, const CutCell& cut)
{
  NearestHit nearest;
  double least = -1.0;
  const auto [i, j, k] = cut.cell;
  for (int link = 0; link < 6; ++link) {
    if (cut.face[link] == open_link)
      continue;
    const int side = link % 2;
    const CutFace& face = links.faces()[cut.face[link]];
    const int hit = side == 1 ? face.first : face.last;
    const double theta = links.crossings()[hit].theta;
    const Index3 other = stepped(cut.cell, link / 2, side == 1 ? 1 : -1);
    const Vec3 to_hit =
        (side == 1 ? theta : 1.0 - theta) * (grid.centre(other[0], other[1], other[2]) - grid.centre(i, j, k));
    if (least < 0.0 || to_hit.norm() < least) {
      least = to_hit.norm();
      nearest = {hit, cut.face[link], side, to_hit};
    }
  }
  return nearest;
}

/// A bilinear patch between four nodes, X(r) = sum_k N_k(r) X_k, and where the line t n from the origin meets it.
struct Patch {
  std::array<Vec3, 4> corner;  ///< (0, 0), (1, 0), (0, 1), (1, 1)

  [[nodiscard]] static std::array<double, 4> weights(double r, double s)
  {
    return {(1.0 - r) * (1.0 - s), r * (1.0 - s), (1.0 - r) * s, r * s};
  }
  /// (t, r, s) by Newton's method; nothing where the line runs along the patch.
  [[nodiscard]] std::optional<Vec3> meet(const Vec3& n, const Vec3& guess) const
  {
    Vec3 x = guess;
    constexpr int enough = 8;  // it is linear but for the skewness of the patch
    for (int iteration = 0; iteration < enough; ++iteration) {
      const auto w = weights(x[1], x[2]);
      Mat3 slope;
      slope.col(0) = -n;
      slope.col(1) = (1.0 - x[2]) * (corner[1] - corner[0]) + x[2] * (corner[3] - corner[2]);
      slope.col(2) = (1.0 - x[1]) * (corner[2] - corner[0]) + x[1] * (corner[3] - corner[1]);
      const Vec3 residual = w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2] + w[3] * corner[3] - x[0] * n;
      const Vec3 change = slope.partialPivLu().solve(residual);
      x -= change;
      if (!x.allFinite())
        return std::nullopt;
      if (std::abs(change[1]) + std::abs(change[2]) < 1e-14)
        break;
    }
    return x;
  }
};

}  // namespace

WallNodes::WallNodes(const grid::Grid& grid)
    : grid_(grid), halo_(grid.ranks()), mark_(grid.owned(), 0), distance_(grid.owned(), 0.0), level_(grid.owned(), 0)
{
}

void WallNodes::freeze(const CutLinks& links)
{
  mark_cells(links);
  find_feet(links);
  find_donors(links);
  find_levels(links);
  find_owned_donors(links);
}

void WallNodes::mark_cells(const CutLinks& links)
{
  mark_.fill(0);
  for (const CutFace& face : links.faces())
    if (grid_.owned().contains(face.cell))
      mark_.view()(face.cell) |= LowFaceCut << face.axis;
  for (const CutCell& cut : links.cells())
    mark_.view()(cut.cell) |= Node;
  halo_.exchange({mark_.view()});
}

/// The closest points of the sheet, side and distance of each node.
void WallNodes::find_feet(const CutLinks& links)
{
  nodes_.assign(links.cells().size(), {});
  const SurfaceWalk surface(links.positions(), links.triangles());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const CutCell& cut = links.cells()[n];
    const NearestHit near = nearest_hit(grid_, links, cut);
    const Crossing& hit = links.crossings()[near.hit];
    const auto& [a, b, c] = links.triangle(hit);
    const auto& x = links.positions();
    // Where the node sees itself from the sheet: across a periodic side it is not where its cell is.
    const Vec3 place = hit.weights[0] * x[a] + hit.weights[1] * x[b] + hit.weights[2] * x[c] - near.to_hit;
    WallNode& node = nodes_[n];
    node.foot = surface.closest(place, hit.triangle);
    node.touched = surface.triangles_at(node.foot);
    node.plus = (near.side == 0) == (hit.side > 0);
    node.decay_time = links.faces()[near.face].passage;
    const Vec3 from_foot = place - node.foot.place;
    node.distance = from_foot.norm();
    const auto [i, j, k] = cut.cell;
    if (node.distance > on_sheet * std::cbrt(grid_.volume(i, j, k))) {
      node.normal = from_foot / node.distance;
    } else {
      const auto& [d, e, f] = links.triangles()[node.foot.triangle];
      node.normal = (node.plus ? 1.0 : -1.0) * surface::area_vector(x[d], x[e], x[f]).normalized();
    }
    distance_.view()(cut.cell) = node.distance;
  }
  halo_.exchange({distance_.view()});
}

/// Vector from the foot of a node at `cell` to the centre of a cell beside it.
Vec3 WallNodes::from_foot(const WallNode& node, const Index3& cell, const Index3& other) const
{
  return node.distance * node.normal + grid_.centre(other[0], other[1], other[2]) -
         grid_.centre(cell[0], cell[1], cell[2]);
}

/// The cell of the domain that stands for one beyond a side.
Index3 WallNodes::beside_side(Index3 cell) const
{
  for (int axis = 0; axis < 3; ++axis)
    if (!grid_.ranks().periodic(axis))
      cell[axis] = std::clamp(cell[axis], 0, grid_.cells()[axis] - 1);
  return cell;
}

/// Whether a path of open links leads from a cell to another one, each step a step nearer.
bool WallNodes::joined(const Index3& from, const Index3& to) const
{
  for (int axis = 0; axis < 3; ++axis) {
    if (from[axis] == to[axis])
      continue;
    const Index3 next = stepped(from, axis, to[axis] > from[axis] ? 1 : -1);
    const Index3& face = to[axis] > from[axis] ? next : from;
    if ((mark_.view()(face) & (LowFaceCut << axis)) == 0 && joined(next, to))
      return true;
  }
  return from == to;
}

/// Whether a cell may give its velocity to a node at a distance from the sheet: cells of the fluid, and nodes farther
/// from the sheet, so that no two wait for each other.  Beyond a side of the domain it is the cell beside the side that
/// decides, and that must be known before all nodes are.
bool WallNodes::gives(const Index3& donor, double distance) const
{
  const Index3 inside = beside_side(donor);
  if ((mark_.view()(inside) & Node) == 0)
    return true;
  return inside == donor && distance_.view()(donor) > (1.0 + least_weight) * distance;
}

void WallNodes::find_donors(const CutLinks& links)
{
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Index3& cell = links.cells()[n].cell;
    if (!find_patch(nodes_[n], cell))
      find_neighbour(nodes_[n], cell);
  }
}

/// The patch that the normal goes through, among those between the 26 cells around.  On straight grids it is the first
/// one looked at.
bool WallNodes::find_patch(WallNode& node, const Index3& cell) const
{
  const Vec3 heading = index_direction(grid_, cell, node.normal);
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(heading[a]) > std::abs(heading[b]); });
  for (const int axis : axes)
    for (const Vec3& side : {Vec3(1, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, -1), Vec3(1, -1, -1)}) {
      Vec3 turned = heading;
      for (int a = 0; a < 3; ++a)
        turned[(axis + a) % 3] *= side[a];
      if (find_patch_along(node, cell, axis, turned))
        return true;
    }
  return false;
}

bool WallNodes::find_patch_along(WallNode& node, const Index3& cell, int axis, const Vec3& heading) const
{
  if (heading[axis] == 0.0)
    return false;
  const int b = (axis + 1) % 3;
  const int c = (axis + 2) % 3;
  const auto step = [&](int a) { return heading[a] < 0.0 ? -1 : 1; };
  const Index3 middle = stepped(cell, axis, step(axis));
  const std::array<Index3, 4> cells{middle, stepped(middle, b, step(b)), stepped(middle, c, step(c)),
                                    stepped(stepped(middle, b, step(b)), c, step(c))};
  Patch patch;
  for (int k = 0; k < 4; ++k)
    patch.corner[k] = from_foot(node, cell, cells[k]);
  const double size = std::abs(heading[axis]);
  const auto met =
      patch.meet(node.normal, {node.distance + 1.0 / size, std::abs(heading[b]) / size, std::abs(heading[c]) / size});
  constexpr double margin = 1e-6;
  if (!met || (*met)[0] <= node.distance || met->tail<2>().minCoeff() < -margin ||
      met->tail<2>().maxCoeff() > 1.0 + margin)
    return false;
  WallNode found = node;
  found.donors = 0;
  const auto w = Patch::weights((*met)[1], (*met)[2]);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (std::abs(w[k]) < least_weight)
      continue;
    if (!joined(cell, beside_side(cells[k])) || !gives(cells[k], node.distance))
      return false;
    found.donor[found.donors] = cells[k];
    found.weight[found.donors++] = w[k];
    sum += w[k];
  }
  for (int k = 0; k < found.donors; ++k)
    found.weight[k] /= sum;
  found.reach = (*met)[0];
  found.on_patch = true;
  node = found;
  return true;
}

/// The neighbour that lies farthest along the normal.
bool WallNodes::find_neighbour(WallNode& node, const Index3& cell) const
{
  for (int link = 0; link < 6; ++link) {
    const Index3 other = stepped(cell, link / 2, link % 2 == 0 ? -1 : 1);
    const Vec3 there = from_foot(node, cell, other);
    const double reach = node.normal.dot(there);
    const double step = (there - node.distance * node.normal).norm();
    if (beside_side(other) != other || reach < node.distance + theta_min * step || reach <= node.reach ||
        !joined(cell, other) || !gives(other, node.distance))
      continue;
    node.donors = 1;
    node.donor[0] = other;
    node.weight[0] = 1.0;
    node.reach = reach;
  }
  return node.donors > 0;
}

/// Nodes that need other nodes come after them.
void WallNodes::find_levels(const CutLinks& links)
{
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    level_.view()(links.cells()[n].cell) = 0;
  highest_level_ = 0;
  for (double changed = 1.0; changed > 0.0;) {
    halo_.exchange({level_.view()});
    changed = 0.0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      WallNode& node = nodes_[n];
      int level = 0;
      for (int k = 0; k < node.donors; ++k)
        if ((mark_.view()(node.donor[k]) & Node) != 0)
          level = std::max(level, level_.view()(node.donor[k]) + 1);
      if (level == node.level)
        continue;
      node.level = level;
      changed = 1.0;
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      level_.view()(links.cells()[n].cell) = nodes_[n].level;
    changed = grid_.ranks().max(changed);
  }
  for (const WallNode& node : nodes_)
    highest_level_ = std::max(highest_level_, node.level);
  highest_level_ = static_cast<int>(grid_.ranks().max(highest_level_));
}

void WallNodes::find_owned_donors(const CutLinks& links)
{
  donors_.clear();
  const IndexBox& owned = grid_.owned();
  const auto mark = mark_.view();
  const auto add_around = [&](int i, int j, int k) {
    const IndexBox box = IndexBox{{i, j, k}, {i + 1, j + 1, k + 1}}.grown(1);
    for_each_cell_in_order(box, [&](int a, int b, int c) {
      if (!owned.contains(a, b, c) || (mark(a, b, c) & (Node | Donor)) != 0)
        return;
      mark(a, b, c) |= Donor;
      donors_.push_back({a, b, c});
    });
  };
  for (const CutCell& cut : links.cells())
    add_around(cut.cell[0], cut.cell[1], cut.cell[2]);
  for (int axis = 0; axis < 3; ++axis)
    for (const int layer : {owned.lo[axis] - 1, owned.hi[axis]}) {
      IndexBox box = owned.grown(1);
      box.lo[axis] = layer;
      box.hi[axis] = layer + 1;
      for_each_cell_in_order(box, [&](int i, int j, int k) {
        if ((mark(i, j, k) & Node) != 0)
          add_around(i, j, k);
      });
    }
}

/// What a node's velocity would be without its offset.
Vec3 WallNodes::value(const CutLinks& links, std::size_t n, const StageTime& time, const View3<const double>& u) const
{
  const WallNode& node = nodes_[n];
  if (node.donors == 0) {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (int link = 0; link < 6; ++link) {
      const int f = links.cells()[n].face[link];
      if (f == open_link)
        continue;
      const int hit = link % 2 == 1 ? links.faces()[f].first : links.faces()[f].last;
      const double theta = links.crossings()[hit].theta;
      const double w = 1.0 / std::max(link % 2 == 1 ? theta : 1.0 - theta, theta_min);
      sum += w * links.velocity(hit, time);
      weights += w;
    }
    return sum / weights;
  }
  const Vec3 u_a = links.velocity_at(node.foot, time);
  Vec3 u_c = Vec3::Zero();
  for (int k = 0; k < node.donors; ++k)
    u_c += node.weight[k] * at(u, node.donor[k]);
  return u_a + node.distance / node.reach * (u_c - u_a);
}

void WallNodes::start_offsets(const CutLinks& links, const View3<const double>& u_old)
{
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Index3& cell = links.cells()[n].cell;
    const std::int64_t number = links.key(0, cell);
    const auto old = std::lower_bound(accepted_.begin(), accepted_.end(), number,
                                      [](const auto& entry, std::int64_t k) { return entry.first < k; });
    if (old != accepted_.end() && old->first == number)
      nodes_[n].offset = old->second;
    else
      nodes_[n].offset = at(u_old, cell) - value(links, n, {0.0, SheetVelocity::Predicted}, u_old);
  }
}

void WallNodes::reconstruct(const CutLinks& links, const StageTime& time, const View3<double>& u)
{
  for (int level = 0; level <= highest_level_; ++level) {
    if (level > 0)
      halo_.exchange(u);
#pragma omp parallel for schedule(static)
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].level != level)
        continue;
      const double decay = std::exp(-time.fraction * links.step_length() / nodes_[n].decay_time);
      const Vec3 v = value(links, n, time, {u[0], u[1], u[2]}) + decay * nodes_[n].offset;
      for (int d = 0; d < 3; ++d)
        u[d](links.cells()[n].cell) = v[d];
    }
  }
}

DonorCounts WallNodes::counts() const
{
  DonorCounts counts{.nodes = static_cast<long>(nodes_.size())};
  for (const WallNode& node : nodes_) {
    counts.single += node.donors > 0 && !node.on_patch ? 1 : 0;
    counts.none += node.donors == 0 ? 1 : 0;
  }
  return counts;
}

void WallNodes::accept(const CutLinks& links)
{
  accepted_.resize(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    accepted_[n] = {links.key(0, links.cells()[n].cell),
                    std::exp(-links.step_length() / nodes_[n].decay_time) * nodes_[n].offset};
}

NodeOffsets WallNodes::accepted_offsets() const
{
  NodeOffsets mine;
  for (const auto& [node, offset] : accepted_) {
    mine.node.push_back(node);
    mine.offset.insert(mine.offset.end(), offset.begin(), offset.end());
  }
  return mine;
}

void WallNodes::restore(const NodeOffsets& of_all_ranks)
{
  accepted_.clear();
  for (std::size_t n = 0; n < of_all_ranks.node.size(); ++n)
    accepted_.emplace_back(of_all_ranks.node[n], Vec3(&of_all_ranks.offset[3 * n]));
  std::sort(accepted_.begin(), accepted_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

}  // namespace luff::immersed

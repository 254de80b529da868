// SPDX-License-Identifier: BSD-3-Clause
// Crossings of general segments by exact signs and one symbolic displacement of the centres; the reasoning is in
// docs/numerics/crossings.md.
#include "immersed/link_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "parallel/for_each.hpp"
#include "parallel/halo.hpp"
#include "parallel/vector_field.hpp"

namespace luff::immersed {

namespace {

/// Links along each edge of a block of the finest level.
constexpr int block_edge = 2;

int blocks_for(int links)
{
  return (links + block_edge - 1) / block_edge;
}

/// n . (x_0 - c') with the displaced centre c' = c - e: how far the triangle's plane lies ahead of c along the normal
/// n. Where it is zero without the displacement, n . e decides, the first component of n that is not zero.
int side_of_plane(const Corners& x, const Vec3& centre)
{
  if (const int ahead = sign_of_volume(x[0], x[1], x[2], centre); ahead != 0)
    return ahead;
  for (int axis = 0; axis < 3; ++axis)
    if (const int normal = sign_of_normal(x, axis); normal != 0)
      return normal;
  return 0;
}

/// Sign of (N' - P') . ((from - P') x (to - P')): which way the line from P to N passes the edge.  Displacing P and N
/// adds e . ((to - from) x (N - P)), whose first component that is not zero decides; zero where both are parallel.
int side_of_edge(const Vec3& from, const Vec3& to, const Vec3& p, const Vec3& n)
{
  if (const int passing = sign_of_volume(n, from, to, p); passing != 0)
    return passing;
  for (int axis = 0; axis < 3; ++axis)
    if (const int cross = sign_of_cross(from, to, p, n, axis); cross != 0)
      return cross;
  return 0;
}

/// Error of weights and theta that is small enough.
constexpr double round_off = 0x1p-44;

/// w_m = V_m/(V_0 + V_1 + V_2), V_m = (N - P) . ((x_{m+1} - P) x (x_{m+2} - P)).  The sum is (N - P) . n.
std::array<double, 3> weights_of_hit(const Vec3& p, const Vec3& n, const Corners& x, int side)
{
  const auto volumes = [&](double error) {
    std::array<double, 3> v;
    for (int m = 0; m < 3; ++m)
      v[m] = std::max(side * volume(n, x[(m + 1) % 3], x[(m + 2) % 3], p, error), 0.0);
    return v;
  };
  const auto sum = [](const std::array<double, 3>& v) { return v[0] + v[1] + v[2]; };
  const double plain = sum(volumes(std::numeric_limits<double>::infinity()));
  std::array<double, 3> weights = volumes(round_off * plain);
  const double total = sum(weights);
  for (double& weight : weights)
    weight /= total;
  return weights;
}

/// theta = n . (x_0 - P)/n . (N - P)
double place_on_link(const Vec3& p, const Vec3& n, const Corners& x)
{
  constexpr double largest_below_one = 0x1.fffffffffffffp-1;
  const auto ahead = [&](const Vec3& centre, double error) { return volume(x[0], x[1], x[2], centre, error); };
  constexpr double any = std::numeric_limits<double>::infinity();
  const double error = round_off * std::abs(ahead(p, any) - ahead(n, any));
  const double ahead_of_p = ahead(p, error);
  return std::clamp(ahead_of_p / (ahead_of_p - ahead(n, error)), 0.0, largest_below_one);
}

/// Whether a segment lies beyond one of the faces of the box from low to high.
bool beyond(const Vec3& p, const Vec3& n, const Vec3& low, const Vec3& high)
{
  bool outside = false;
  for (int d = 0; d < 3; ++d)
    outside |= std::max(p[d], n[d]) < low[d] || std::min(p[d], n[d]) > high[d];
  return outside;
}

struct SegmentHit {
  double theta;
  std::array<double, 3> weights;
  int side;
};

/// Where the displaced segment from P to N passes through the triangle, if it does.
std::optional<SegmentHit> hit_on_segment(const Vec3& p, const Vec3& n, const Corners& x)
{
  const int side = side_of_plane(x, p);
  if (side == 0 || side_of_plane(x, n) != -side)
    return std::nullopt;
  for (int m = 0; m < 3; ++m)
    if (side_of_edge(x[(m + 1) % 3], x[(m + 2) % 3], p, n) != side)
      return std::nullopt;

  return SegmentHit{place_on_link(p, n, x), weights_of_hit(p, n, x, side), side};
}

}  // namespace

LinkTree::LinkTree(const Decomposition& ranks, Field3<double> centres, const std::array<Vec3, 3>& periods)
    : cells_(ranks.cells()), centres_(std::move(centres))
{
  const std::array<Vec3, 2> unmoved{Vec3::Zero(), Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const int last = cells_[axis];
    IndexBox inner = ranks.owned().faces(axis);
    inner.lo[axis] = std::max(inner.lo[axis], 1);
    inner.hi[axis] = std::min(inner.hi[axis], last);
    add_branch(axis, inner, unmoved);
    if (!ranks.periodic(axis))
      continue;
    for (const int face : {0, last}) {
      IndexBox outermost = ranks.owned().faces(axis);
      outermost.lo[axis] = std::max(outermost.lo[axis], face);
      outermost.hi[axis] = std::min(outermost.hi[axis], face + 1);
      add_branch(axis, outermost, {-periods[axis], Vec3::Zero()});
      if (periods[axis] != Vec3::Zero())
        add_branch(axis, outermost, {Vec3::Zero(), periods[axis]});
    }
  }
}

void LinkTree::add_branch(int axis, const IndexBox& faces, const std::array<Vec3, 2>& shift)
{
  if (faces.volume() == 0)
    return;
  branches_.push_back({axis, faces, shift, {}});
  add_levels(branches_.back());
}

std::array<Vec3, 2> LinkTree::ends(const Branch& branch, const Index3& face) const
{
  std::array<Vec3, 2> x = branch.shift;
  for (int d = 0; d < 3; ++d) {
    const View<const double> centre = centres_[d].view();
    const double* const n = &centre(face);
    x[0][d] += *(n - centre.stride(branch.axis));
    x[1][d] += *n;
  }
  return x;
}

LinkTree::Box LinkTree::box_around(std::span<const Vec3> points)
{
  constexpr float beyond = std::numeric_limits<float>::infinity();
  Box box{};
  for (int d = 0; d < 3; ++d) {
    double low = points[0][d];
    double high = low;
    for (const Vec3& x : points.subspan(1)) {
      low = std::min(low, x[d]);
      high = std::max(high, x[d]);
    }
    box.low[d] = std::nextafter(static_cast<float>(low), -beyond);
    box.high[d] = std::nextafter(static_cast<float>(high), beyond);
  }
  return box;
}

bool LinkTree::overlap(const Box& p, const Box& q)
{
  bool apart = false;
  for (int d = 0; d < 3; ++d)
    apart |= p.low[d] > q.high[d] || q.low[d] > p.high[d];
  return !apart;
}

IndexBox LinkTree::links_of_block(const Branch& branch, const Index3& block)
{
  IndexBox box;
  for (int d = 0; d < 3; ++d) {
    box.lo[d] = branch.faces.lo[d] + block_edge * block[d];
    box.hi[d] = box.lo[d] + block_edge;
  }
  return intersection(box, branch.faces);
}

void LinkTree::add_levels(Branch& branch) const
{
  const auto join = [](Box& to, const Box& from) {
    for (int d = 0; d < 3; ++d) {
      to.low[d] = std::min(to.low[d], from.low[d]);
      to.high[d] = std::max(to.high[d], from.high[d]);
    }
  };
  Level finest;
  for (int d = 0; d < 3; ++d)
    finest.blocks[d] = blocks_for(branch.faces.extent(d));
  for_each_cell_in_order({{0, 0, 0}, finest.blocks}, [&](int i, int j, int k) {
    const IndexBox links = links_of_block(branch, {i, j, k});
    Box box = box_around(ends(branch, links.lo));
    for_each_cell_in_order(links, [&](int l, int m, int n) { join(box, box_around(ends(branch, {l, m, n}))); });
    finest.boxes.push_back(box);
  });
  branch.levels.push_back(std::move(finest));
  while (branch.levels.back().boxes.size() > 1) {
    const Level& fine = branch.levels.back();
    const auto box_of = [&fine](const Index3& b) {
      return fine.boxes[(static_cast<std::size_t>(b[2]) * fine.blocks[1] + b[1]) * fine.blocks[0] + b[0]];
    };
    Level coarse;
    for (int d = 0; d < 3; ++d)
      coarse.blocks[d] = (fine.blocks[d] + 1) / 2;
    for_each_cell_in_order({{0, 0, 0}, coarse.blocks}, [&](int i, int j, int k) {
      const IndexBox children =
          intersection({{2 * i, 2 * j, 2 * k}, {2 * i + 2, 2 * j + 2, 2 * k + 2}}, {{0, 0, 0}, fine.blocks});
      Box box = box_of(children.lo);
      for_each_cell_in_order(children, [&](int l, int m, int n) { join(box, box_of({l, m, n})); });
      coarse.boxes.push_back(box);
    });
    branch.levels.push_back(std::move(coarse));
  }
}

void LinkTree::visit(const Branch& branch, int level, const Index3& block, const Triangle& triangle,
                     std::vector<Crossing>& found) const
{
  const Level& here = branch.levels[level];
  const std::size_t number =
      (static_cast<std::size_t>(block[2]) * here.blocks[1] + block[1]) * here.blocks[0] + block[0];
  if (!overlap(here.boxes[number], triangle.box))
    return;
  if (level == 0) {
    visit_links(branch, block, triangle, found);
    return;
  }
  const IndexBox children =
      intersection({{2 * block[0], 2 * block[1], 2 * block[2]}, {2 * block[0] + 2, 2 * block[1] + 2, 2 * block[2] + 2}},
                   {{0, 0, 0}, branch.levels[level - 1].blocks});
  for_each_cell_in_order(children, [&](int i, int j, int k) { visit(branch, level - 1, {i, j, k}, triangle, found); });
}

void LinkTree::visit_links(const Branch& branch, const Index3& block, const Triangle& triangle,
                           std::vector<Crossing>& found) const
{
  for_each_cell_in_order(links_of_block(branch, block), [&](int i, int j, int k) {
    const auto [p, n] = ends(branch, {i, j, k});
    if (beyond(p, n, triangle.low, triangle.high))
      return;
    if (const auto hit = hit_on_segment(p, n, triangle.x))
      found.push_back({branch.axis, {i, j, k}, hit->theta, triangle.number, hit->weights, hit->side});
  });
}

std::vector<Crossing> LinkTree::find_crossings(std::span<const Vec3> positions,
                                               std::span<const std::array<int, 3>> triangles) const
{
  std::vector<Crossing> found;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Corners x{positions[a], positions[b], positions[c]};
    const Triangle triangle{x, t, box_around(x), x[0].cwiseMin(x[1]).cwiseMin(x[2]),
                            x[0].cwiseMax(x[1]).cwiseMax(x[2])};
    for (const Branch& branch : branches_)
      visit(branch, static_cast<int>(branch.levels.size()) - 1, {0, 0, 0}, triangle, found);
  }
  sort(found, cells_);
  return found;
}

std::unique_ptr<const LinkTree> make_link_tree(const grid::Grid& grid)
{
  auto centres = make_field3<double>(grid.owned());
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    const Vec3 x = grid.centre(i, j, k);
    for (int d = 0; d < 3; ++d)
      centres[d](i, j, k) = x[d];
  });
  HaloExchange(grid.ranks()).exchange(views(centres));
  std::array<Vec3, 3> periods{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    if (!grid.ranks().periodic(axis))
      continue;
    // The rank of the first cell knows the one before it here and, in its halo, where the neighbour has it.
    const Index3 before = stepped({0, 0, 0}, axis, -1);
    if (grid.owned().contains(0, 0, 0)) {
      const Vec3 period = at(views(centres), before) - grid.centre(before);
      const Vec3 link = grid.centre(0, 0, 0) - grid.centre(before);
      constexpr double ring = 0x1p-30;  // far above round-off, far below the one cell that a period has at least
      if (period.norm() > ring * link.norm())
        periods[axis] = period;
    }
    for (int d = 0; d < 3; ++d)
      periods[axis][d] = grid.ranks().sum(periods[axis][d]);
  }
  return std::make_unique<const LinkTree>(grid.ranks(), std::move(centres), periods);
}

}  // namespace luff::immersed

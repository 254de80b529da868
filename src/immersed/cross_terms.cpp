// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cross_terms.hpp"

#include "immersed/cell_metric.hpp"
#include "immersed/cut_axis.hpp"
#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"

namespace luff::immersed {

namespace {

enum Mark { Bulk = 0, Cut = 1, Beside = 2 };

/// Component G_ab of the metric tensor of a cell.
double tensor(const grid::Curvilinear& metric, int a, int b, const Index3& cell)
{
  return metric.G[grid::symmetric(a, b)](cell);
}

}  // namespace

CrossTerms::CrossTerms(const grid::Grid& grid)
    : grid_(grid),
      metric_(*curvilinear_metric(grid)),
      halo_(grid.ranks()),
      kind_(grid.owned(), Bulk),
      change_{make_field3<double>(grid.owned()), make_field3<double>(grid.owned()), make_field3<double>(grid.owned())}
{
}

void CrossTerms::freeze(const CutLinks& links)
{
  for (const Index3& c : cut_) {
    kind_.view()(c) = Bulk;
    for (auto& component : change_)
      for (auto& field : component)
        field.view()(c) = 0.0;
  }
  for (const Index3& c : neighbours_)
    kind_.view()(c) = Bulk;
  cut_.clear();
  neighbours_.clear();
  for (const CutCell& cut : links.cells()) {
    cut_.push_back(cut.cell);
    kind_.view()(cut.cell) = Cut;
  }
  halo_.exchange({kind_.view()});
  const auto add_beside = [&](const Index3& cut) {
    for (int link = 0; link < 6; ++link) {
      const Index3 beside = stepped(cut, link / 2, link % 2 == 0 ? -1 : 1);
      if (!grid_.owned().contains(beside) || kind_.view()(beside) != Bulk)
        continue;
      kind_.view()(beside) = Beside;
      neighbours_.push_back(beside);
    }
  };
  for (const Index3& c : cut_)
    add_beside(c);
  const IndexBox& owned = grid_.owned();
  for (int axis = 0; axis < 3; ++axis)
    for (const int layer : {owned.lo[axis] - 1, owned.hi[axis]}) {
      IndexBox box = owned;
      box.lo[axis] = layer;
      box.hi[axis] = layer + 1;
      for_each_cell_in_order(box, [&](int i, int j, int k) {
        if (kind_(i, j, k) == Cut && !beyond_domain(axis, {i, j, k}))
          add_beside({i, j, k});
      });
    }
}

bool CrossTerms::beyond_domain(int axis, const Index3& cell) const
{
  return !grid_.ranks().periodic(axis) && (cell[axis] < 0 || cell[axis] >= grid_.cells()[axis]);
}

void CrossTerms::update(const CutLinks& links, const View3<const double>& u, const StageTime& time)
{
  for (const CutCell& cut : links.cells()) {
    std::array<Vec3, 3> change{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (int b = 0; b < 3; ++b) {
      if (cut.face[2 * b] == open_link && cut.face[2 * b + 1] == open_link)
        continue;
      const CutAxis along = cut_axis(grid_, links, cut, b, time);
      const auto [low, high] = velocities_beside(links, cut, b, along, u, time);
      const Vec3 across = 0.5 * (at(u, stepped(cut.cell, b, 1)) - at(u, stepped(cut.cell, b, -1)));
      const Vec3 difference = along.difference(low, high) - across;
      for (const int a : {(b + 1) % 3, (b + 2) % 3})
        change[a] += tensor(metric_, a, b, cut.cell) * difference;
    }
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c)
        change_[a][c].view()(cut.cell) = change[a][c];
  }
  for (auto& component : change_)
    halo_.exchange(views(component));
}

Vec3 CrossTerms::w(int axis, const Index3& cell, const View3<const double>& u) const
{
  Vec3 sum = at(views(change_[axis]), cell);
  for (const int b : {(axis + 1) % 3, (axis + 2) % 3})
    sum += 0.5 * tensor(metric_, axis, b, cell) * (at(u, stepped(cell, b, 1)) - at(u, stepped(cell, b, -1)));
  return sum;
}

Vec3 CrossTerms::net_outflow(const CutCell& cut, const View3<const double>& u) const
{
  Vec3 net = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 here = w(axis, cut.cell, u);
    std::array<Vec3, 2> beside{here, here};
    int open = 0;
    for (int side = 0; side < 2; ++side) {
      if (cut.face[2 * axis + side] != open_link)
        continue;
      ++open;
      const Index3 c = stepped(cut.cell, axis, side == 0 ? -1 : 1);
      if (!beyond_domain(axis, c))
        beside[side] = w(axis, c, u);
    }
    net += (open == 2 ? 0.5 : 1.0) * (beside[1] - beside[0]);
  }
  return net;
}

Vec3 CrossTerms::at_wall(const CutCell& cut, int axis, int side, const View3<const double>& u) const
{
  const Vec3 here = w(axis, cut.cell, u);
  const Index3 behind = stepped(cut.cell, axis, side == 0 ? 1 : -1);
  if (cut.face[2 * axis + 1 - side] != open_link || beyond_domain(axis, behind))
    return here;
  return 1.5 * here - 0.5 * w(axis, behind, u);
}

Vec3 CrossTerms::change_in_neighbour(const Index3& cell) const
{
  Vec3 change = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      const Index3 beside = stepped(cell, axis, step);
      if (!beyond_domain(axis, beside))
        change += 0.5 * step * at(views(change_[axis]), beside);
    }
  return change;
}

}  // namespace luff::immersed

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
      Vec3 difference = Vec3::Zero();
      for (const LinkForm& form : LinkForms(links, cut, b)) {
        const CutAxis along = cut_axis(links, cut, b, time, form.cut);
        const auto [low, high] = velocities_beside(links, cut, b, along, u, time);
        difference += form.weight * along.difference(low, high);
      }
      difference -= 0.5 * (at(u, stepped(cut.cell, b, 1)) - at(u, stepped(cut.cell, b, -1)));
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

/// w_a of the cell beside a cut cell, or of itself beyond a side of the domain.
Vec3 CrossTerms::w_beside(const CutCell& cut, int axis, int side, const View3<const double>& u) const
{
  const Index3 beside = stepped(cut.cell, axis, side == 0 ? -1 : 1);
  return w(axis, beyond_domain(axis, beside) ? cut.cell : beside, u);
}

Vec3 CrossTerms::net_outflow(const CutLinks& links, const CutCell& cut, const View3<const double>& u) const
{
  Vec3 net = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 here = w(axis, cut.cell, u);
    for (const LinkForm& form : LinkForms(links, cut, axis)) {
      const Vec3 low = form.cut[0] ? here : w_beside(cut, axis, 0, u);
      const Vec3 high = form.cut[1] ? here : w_beside(cut, axis, 1, u);
      net += form.weight * (form.any_cut() ? 1.0 : 0.5) * (high - low);
    }
  }
  return net;
}

Vec3 CrossTerms::at_wall(const CutLinks& links, const CutCell& cut, int axis, int side,
                         const View3<const double>& u) const
{
  const Vec3 here = w(axis, cut.cell, u);
  const double closed_behind = cover(links, cut, axis, 1 - side);
  if (closed_behind == 1.0)
    return here;
  return closed_behind * here + (1.0 - closed_behind) * (1.5 * here - 0.5 * w_beside(cut, axis, 1 - side, u));
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

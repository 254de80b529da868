// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/flow_points.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/for_each.hpp"
#include "parallel/halo.hpp"
#include "simulation/velocity_gradient.hpp"

namespace luff::simulation {

namespace {

/// A point stands on the centre of a cell, or between it and the one beyond the side of the domain.
struct Stand {
  int cell = 0;
  int beyond = 0;  ///< the cell itself where the point is its centre
};

/// Along one axis: on the side where the domain begins, the centres, and the side where it ends or the next centre.
std::vector<Stand> points_along(const grid::Grid& grid, int axis)
{
  const int lo = grid.owned().lo[axis];
  const int hi = grid.owned().hi[axis];
  std::vector<Stand> points;
  if (lo == 0)
    points.push_back({0, -1});
  for (int i = lo; i < hi; ++i)
    points.push_back({i, i});
  points.push_back(hi == grid.cells()[axis] ? Stand{hi - 1, hi} : Stand{hi, hi});
  return points;
}

/// Of the points, i fastest; on sides, edges and corners of the domain
///
///   f = f_P + sum over the axes of (f_beyond - f_P)/2.
template <class Value, class OfCell>
std::vector<Value> by_point(const std::array<std::vector<Stand>, 3>& points, OfCell of_cell)
{
  std::vector<Value> values;
  for (const Stand& k : points[2])
    for (const Stand& j : points[1])
      for (const Stand& i : points[0]) {
        const Index3 cell{i.cell, j.cell, k.cell};
        const Index3 beyond{i.beyond, j.beyond, k.beyond};
        const Value here = of_cell(cell);
        Value value = here;
        for (int a = 0; a < 3; ++a)
          if (beyond[a] != cell[a])
            value += 0.5 * (of_cell(stepped(cell, a, beyond[a] - cell[a])) - here);
        values.push_back(value);
      }
  return values;
}

output::NamedField named(const std::string& name, const std::vector<Vec3>& values)
{
  std::vector<float> flat;
  for (const Vec3& v : values)
    for (const double x : v)
      flat.push_back(static_cast<float>(x));
  return {name, 3, std::move(flat)};
}

output::NamedField named(const std::string& name, const std::vector<double>& values)
{
  return {name, 1, std::vector<float>(values.begin(), values.end())};
}

/// Cells beyond a side of the domain take the value of the one inside.
Index3 inside(const grid::Grid& grid, Index3 c)
{
  for (int a = 0; a < 3; ++a)
    if (!grid.ranks().periodic(a))
      c[a] = std::clamp(c[a], 0, grid.cells()[a] - 1);
  return c;
}

/// A field that only owned cells have, by point.
template <class OfCell>
std::vector<double> scalar_by_point(const grid::Grid& grid, const std::array<std::vector<Stand>, 3>& points,
                                    OfCell of_cell)
{
  Field<double> field(grid.owned());
  const View<double> values = field.view();
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { values(i, j, k) = of_cell(Index3{i, j, k}); });
  HaloExchange(grid.ranks()).exchange({values});
  return by_point<double>(points, [&](const Index3& c) { return values(inside(grid, c)); });
}

output::NamedField field_by_point(const fluid::FlowSolver& flow, config::FlowField what,
                                  const std::array<std::vector<Stand>, 3>& points)
{
  const grid::Grid& grid = flow.grid();
  const View3<const double> u = views(flow.state().u);
  const auto gradient = [&](const Index3& c) { return velocity_gradient(grid, u, c); };
  switch (what) {
    case config::FlowField::Velocity:
      return named("velocity", by_point<Vec3>(points, [&](const Index3& c) -> Vec3 { return at(u, c); }));
    case config::FlowField::Pressure:
      return named("pressure", scalar_by_point(grid, points, [&](const Index3& c) {
                     return flow.options().density * flow.state().p.view()(c);
                   }));
    case config::FlowField::QCriterion:
      return named("q_criterion",
                   scalar_by_point(grid, points, [&](const Index3& c) { return q_criterion(gradient(c)); }));
    case config::FlowField::Vorticity:
      break;
  }
  std::array<std::vector<double>, 3> component;
  for (int d = 0; d < 3; ++d)
    component[d] = scalar_by_point(grid, points, [&](const Index3& c) { return vorticity(gradient(c))[d]; });
  std::vector<Vec3> omega;
  for (std::size_t n = 0; n < component[0].size(); ++n)
    omega.emplace_back(component[0][n], component[1][n], component[2][n]);
  return named("vorticity", omega);
}

}  // namespace

output::PointBlock flow_points(const fluid::FlowSolver& flow, std::span<const config::FlowField> what, bool bodies)
{
  const grid::Grid& grid = flow.grid();
  std::array<std::vector<Stand>, 3> points;
  output::PointBlock block;
  for (int a = 0; a < 3; ++a) {
    points[a] = points_along(grid, a);
    block.points[a] = static_cast<int>(points[a].size());
  }
  block.places = by_point<Vec3>(points, [&](const Index3& c) -> Vec3 { return grid.centre(c); });
  for (const config::FlowField field : what)
    block.fields.push_back(field_by_point(flow, field, points));
  if (bodies)
    block.fields.push_back(named("fluid", scalar_by_point(grid, points, [&](const Index3& c) {
                                   return flow.links().is_inside(c) ? 0.0 : 1.0;
                                 })));
  return block;
}

std::vector<float> magnitudes(const output::NamedField& field)
{
  const auto& values = std::get<std::vector<float>>(field.values);
  if (field.components == 1)
    return values;
  std::vector<float> sizes;
  for (std::size_t n = 0; n < values.size(); n += 3)
    sizes.push_back(std::hypot(values[n], values[n + 1], values[n + 2]));
  return sizes;
}

}  // namespace luff::simulation

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/flow_fields.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/vector_field.hpp"

namespace luff::simulation {

namespace {

/// (grad u)_ij = du_i/dx_j at the centre of a cell.
Mat3 velocity_gradient(const grid::Grid& grid, const View3<const double>& u, const Index3& c)
{
  Mat3 gradient;
  for (int j = 0; j < 3; ++j) {
    const double span = grid.centre(j, c[j] + 1) - grid.centre(j, c[j] - 1);
    gradient.col(j) = (at(u, stepped(c, j, 1)) - at(u, stepped(c, j, -1))) / span;
  }
  return gradient;
}

Vec3 vorticity(const Mat3& g)
{
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

/// Q = -1/2 tr(G G): positive where rotation wins over strain [hunt_1988_eddies].
double q_criterion(const Mat3& g)
{
  return -0.5 * (g * g).trace();
}

/// Values of `components` numbers per owned cell, i fastest.
template <class Value>
output::NamedField cell_field(const std::string& name, int components, const IndexBox& box, Value value)
{
  std::vector<float> values;
  values.reserve(box.volume() * components);
  for_each_cell_in_order(box, [&](int i, int j, int k) {
    const auto v = value(Index3{i, j, k});
    if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
      values.push_back(static_cast<float>(v));
    else
      for (int d = 0; d < 3; ++d)
        values.push_back(static_cast<float>(v[d]));
  });
  return {name, components, std::move(values)};
}

}  // namespace

output::FlowSnapshot flow_snapshot(const fluid::FlowSolver& flow, std::span<const config::FlowField> what, bool bodies)
{
  const grid::Grid& grid = flow.grid();
  const auto u = views(flow.state().u);
  const auto p = flow.state().p.view();
  output::FlowSnapshot snapshot;
  for (int a = 0; a < 3; ++a)
    snapshot.nodes[a] = grid.faces(a);
  snapshot.piece = grid.owned();
  for (const config::FlowField field : what)
    switch (field) {
      case config::FlowField::Velocity:
        snapshot.fields.push_back(
            cell_field("velocity", 3, grid.owned(), [&](const Index3& c) -> Vec3 { return at(u, c); }));
        break;
      case config::FlowField::Pressure:
        snapshot.fields.push_back(cell_field("pressure", 1, grid.owned(),
                                             [&](const Index3& c) -> double { return flow.options().density * p(c); }));
        break;
      case config::FlowField::Vorticity:
        snapshot.fields.push_back(cell_field("vorticity", 3, grid.owned(), [&](const Index3& c) -> Vec3 {
          return vorticity(velocity_gradient(grid, u, c));
        }));
        break;
      case config::FlowField::QCriterion:
        snapshot.fields.push_back(cell_field("q_criterion", 1, grid.owned(), [&](const Index3& c) -> double {
          return q_criterion(velocity_gradient(grid, u, c));
        }));
        break;
    }
  if (bodies)
    snapshot.fields.push_back(cell_field(
        "fluid", 1, grid.owned(), [&](const Index3& c) -> double { return flow.links().is_inside(c) ? 0.0 : 1.0; }));
  return snapshot;
}

PointSample sample(const fluid::FlowSolver& flow, const Vec3& x)
{
  const grid::Grid& grid = flow.grid();
  Index3 cell{};  // that holds the point
  Index3 base{};  // low corner of the box of centres around it
  Vec3 weight;
  for (int a = 0; a < 3; ++a) {
    const auto& faces = grid.faces(a);
    const auto above = std::upper_bound(faces.begin(), faces.end(), x[a]) - faces.begin();
    cell[a] = std::clamp(static_cast<int>(above) - 1, 0, grid.cells()[a] - 1);
    base[a] = x[a] < grid.centre(a, cell[a]) ? cell[a] - 1 : cell[a];
    if (!grid.ranks().periodic(a))  // between a wall and the first centre: continued from within
      base[a] = std::clamp(base[a], 0, std::max(0, grid.cells()[a] - 2));
    weight[a] = (x[a] - grid.centre(a, base[a])) / (grid.centre(a, base[a] + 1) - grid.centre(a, base[a]));
  }
  std::array<double, 4> sum{};
  if (grid.owned().contains(cell))
    for (int corner = 0; corner < 8; ++corner) {
      Index3 c = base;
      double w = 1.0;
      for (int a = 0; a < 3; ++a) {
        const int up = corner >> a & 1;
        c[a] += up;
        w *= up == 1 ? weight[a] : 1.0 - weight[a];
      }
      const Vec3 u = at(views(flow.state().u), c);
      for (int d = 0; d < 3; ++d)
        sum[d] += w * u[d];
      sum[3] += w * flow.options().density * flow.state().p.view()(c);
    }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 4, MPI_DOUBLE, MPI_SUM, grid.ranks().comm());
  return {{sum[0], sum[1], sum[2]}, sum[3]};
}

}  // namespace luff::simulation

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/flow_fields.hpp"

#include <Eigen/LU>

#include "parallel/vector_field.hpp"
#include "simulation/grid_snapshot.hpp"

namespace luff::simulation {

namespace {

/// (grad u)_ij = du_i/dx_j at the centre of a cell, from the differences between its neighbours along the three index
/// directions a:  grad u . (x(+a) - x(-a)) = u(+a) - u(-a).  Exact where u is linear, on grids of any kind.
Mat3 velocity_gradient(const grid::Grid& grid, const View3<const double>& u, const Index3& c)
{
  Mat3 du;
  Mat3 dx;
  for (int a = 0; a < 3; ++a) {
    const Index3 high = stepped(c, a, 1);
    const Index3 low = stepped(c, a, -1);
    du.col(a) = at(u, high) - at(u, low);
    dx.col(a) = grid.centre(high) - grid.centre(low);
  }
  return du * dx.inverse();
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

}  // namespace

output::FlowSnapshot flow_snapshot(const fluid::FlowSolver& flow, std::span<const config::FlowField> what, bool bodies)
{
  const grid::Grid& grid = flow.grid();
  const auto u = views(flow.state().u);
  const auto p = flow.state().p.view();
  output::FlowSnapshot snapshot = grid_snapshot(grid);
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

PointSample sample(const fluid::FlowSolver& flow, const grid::Location& location)
{
  const grid::Grid& grid = flow.grid();
  std::array<double, 4> sum{};
  if (location.mine)
    for (int corner = 0; corner < 8; ++corner) {
      Index3 c = location.base;
      double w = 1.0;
      for (int a = 0; a < 3; ++a) {
        const int up = corner >> a & 1;
        c[a] += up;
        w *= up == 1 ? location.weight[a] : 1.0 - location.weight[a];
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

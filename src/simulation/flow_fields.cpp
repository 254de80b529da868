// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/flow_fields.hpp"

#include "parallel/vector_field.hpp"
#include "simulation/grid_snapshot.hpp"
#include "simulation/velocity_gradient.hpp"

namespace luff::simulation {

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

std::vector<PointSample> sample(const fluid::FlowSolver& flow, std::span<const grid::Location> places)
{
  constexpr std::size_t numbers = 4;  // of a place: velocity and pressure
  std::vector<double> sums(numbers * places.size(), 0.0);
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (!places[n].mine)
      continue;
    for (int corner = 0; corner < 8; ++corner) {
      Index3 c = places[n].base;
      double w = 1.0;
      for (int a = 0; a < 3; ++a) {
        const int up = corner >> a & 1;
        c[a] += up;
        w *= up == 1 ? places[n].weight[a] : 1.0 - places[n].weight[a];
      }
      const Vec3 u = at(views(flow.state().u), c);
      for (int d = 0; d < 3; ++d)
        sums[numbers * n + d] += w * u[d];
      sums[numbers * n + 3] += w * flow.options().density * flow.state().p.view()(c);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                flow.grid().ranks().comm());
  std::vector<PointSample> samples;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double* of = &sums[numbers * n];
    samples.push_back({{of[0], of[1], of[2]}, of[3]});
  }
  return samples;
}

}  // namespace luff::simulation

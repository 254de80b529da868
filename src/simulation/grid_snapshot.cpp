// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/grid_snapshot.hpp"

#include "grid/quality.hpp"

namespace luff::simulation {

output::FlowSnapshot grid_snapshot(const grid::Grid& grid)
{
  output::FlowSnapshot snapshot;
  snapshot.piece = grid.owned();
  grid.visit([&]<class Metric>(const Metric& m) {
    if constexpr (grid::is_curvilinear<Metric>) {
      output::CurvilinearPiece nodes{.cells = grid.cells(), .points = {}};
      for_each_cell_in_order(grid.owned().faces(0).faces(1).faces(2), [&](int i, int j, int k) {
        nodes.points.emplace_back(m.node[0](i, j, k), m.node[1](i, j, k), m.node[2](i, j, k));
      });
      snapshot.nodes = std::move(nodes);
    } else {
      snapshot.nodes = output::RectilinearNodes{grid.faces(0), grid.faces(1), grid.faces(2)};
    }
  });
  return snapshot;
}

output::FlowSnapshot quality_snapshot(const grid::Grid& grid)
{
  output::FlowSnapshot snapshot = grid_snapshot(grid);
  const auto add = [&](const std::string& name, auto number) {
    snapshot.fields.push_back(
        cell_field(name, 1, grid.owned(), [&](const Index3& c) -> double { return number(c[0], c[1], c[2]); }));
  };
  add("volume", [&](int i, int j, int k) { return grid.volume(i, j, k); });
  add("skew", [&](int i, int j, int k) { return grid::cell_quality(grid, i, j, k).skew; });
  add("aspect_ratio", [&](int i, int j, int k) { return grid::cell_quality(grid, i, j, k).aspect; });
  return snapshot;
}

}  // namespace luff::simulation

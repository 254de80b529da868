// SPDX-License-Identifier: BSD-3-Clause
// A flow and a sheet whose numbers are known at every place.
#pragma once

#include <cmath>

#include "output/snapshot.hpp"

namespace luff::output::test {

/// Stretched so that a mistaken coordinate shows.
inline std::vector<double> stretched_nodes(double from, double to, int cells)
{
  std::vector<double> nodes;
  for (int i = 0; i <= cells; ++i) {
    const double s = static_cast<double>(i) / cells;
    nodes.push_back(from + (to - from) * (0.7 * s + 0.3 * s * s));
  }
  return nodes;
}

inline double centre(const std::vector<double>& nodes, int i)
{
  return 0.5 * (nodes[i] + nodes[i + 1]);
}

/// Velocity (x, y, z), pressure 100 x + 10 y + z, vorticity of a vortex about the z axis, by cell of the piece.
inline FlowSnapshot sample_flow(const Index3& cells, const IndexBox& piece, double t = 0)
{
  FlowSnapshot flow;
  const RectilinearNodes nodes{stretched_nodes(-2, 4, cells[0]), stretched_nodes(-2, 2, cells[1]),
                               stretched_nodes(-0.5, 0.5, cells[2])};
  flow.nodes = nodes;
  flow.piece = piece;
  std::vector<float> velocity, vorticity;
  std::vector<double> pressure;
  for (int k = piece.lo[2]; k < piece.hi[2]; ++k)
    for (int j = piece.lo[1]; j < piece.hi[1]; ++j)
      for (int i = piece.lo[0]; i < piece.hi[0]; ++i) {
        const double x = centre(nodes[0], i), y = centre(nodes[1], j), z = centre(nodes[2], k);
        for (double u : {x, y, z})
          velocity.push_back(static_cast<float>(u));
        pressure.push_back(100 * x + 10 * y + z);
        const double swirl = std::exp(-4 * (std::pow(x - 1.5 - 0.3 * t, 2) + std::pow(y - 0.4, 2))) -
                             std::exp(-4 * (std::pow(x - 2.3 - 0.3 * t, 2) + std::pow(y + 0.4, 2)));
        for (double w : {0., 0., 8 * swirl})
          vorticity.push_back(static_cast<float>(w));
      }
  flow.fields = {{"velocity", 3, velocity}, {"pressure", 1, pressure}, {"vorticity", 3, vorticity}};
  return flow;
}

/// The same numbers on cells whose nodes are put elsewhere.
inline FlowSnapshot sample_curvilinear_flow(const Index3& cells, const IndexBox& piece, double t = 0)
{
  FlowSnapshot flow = sample_flow(cells, piece, t);
  const auto nodes = std::get<RectilinearNodes>(flow.nodes);
  CurvilinearPiece points{.cells = cells, .points = {}};
  for (int k = piece.lo[2]; k <= piece.hi[2]; ++k)
    for (int j = piece.lo[1]; j <= piece.hi[1]; ++j)
      for (int i = piece.lo[0]; i <= piece.hi[0]; ++i)
        points.points.emplace_back(nodes[0][i] + 0.2 * nodes[1][j], nodes[1][j], nodes[2][k] + 0.1 * nodes[0][i]);
  flow.nodes = points;
  return flow;
}

/// A sheet of 2 n n triangles over 0 <= x <= 1, -0.5 <= z <= 0.5 that waves in y.
inline SurfaceSnapshot sample_sheet(int n, double t = 0)
{
  SurfaceSnapshot sheet;
  std::vector<double> displacement, load;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = 0.3 * x * std::sin(3 * x - 2 * t);
      sheet.points.emplace_back(x, y, static_cast<double>(j) / n - 0.5);
      displacement.insert(displacement.end(), {0., y, 0.});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      sheet.triangles.push_back({a, a + 1, a + n + 2});
      sheet.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  for (std::size_t e = 0; e < sheet.triangles.size(); ++e)
    load.push_back(static_cast<double>(e));
  sheet.point_fields = {{"displacement", 3, displacement}};
  sheet.face_fields = {{"load", 1, load}};
  return sheet;
}

}  // namespace luff::output::test

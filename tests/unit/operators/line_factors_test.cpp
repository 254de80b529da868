// SPDX-License-Identifier: BSD-3-Clause
#include "operators/line_factors.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/faces.hpp"

namespace luff::operators {
namespace {

constexpr double tau = 0.3;
constexpr double viscosity = 0.05;

constexpr std::array<std::array<bool, 2>, 3> holds{{{true, false}, {false, false}, {true, true}}};

/// v + tau L_a v along one axis, lines ending with the box.
Field<double> factor(const grid::Grid& grid, int a, const Field3<double>& U, const Field<double>& v)
{
  Field<double> result(v);
  const IndexBox& box = grid.owned();
  for_each_cell_in_order(box, [&](int i, int j, int k) {
    const Index3 c{i, j, k};
    double net = 0.0;
    for (int end = 0; end < 2; ++end) {
      const Index3 face = stepped(c, a, end);
      const Index3 beyond = stepped(c, a, end == 0 ? -1 : 1);
      const bool inside = box.contains(beyond);
      const double v_beyond = inside ? v.view()(beyond) : 0.0;
      const double sign = end == 0 ? -1.0 : 1.0;
      net += sign * U[a].view()(face) * 0.5 * (v(i, j, k) + v_beyond);
      const double area = grid.area(a, i, j, k);
      if (inside) {
        net -= viscosity * area * (v_beyond - v(i, j, k)) / grid.distance(a, face[a]);
      } else if (holds[a][end]) {
        const Index3 inner = stepped(c, a, end == 0 ? 1 : -1);
        const double d1 = 0.5 * grid.width(a, c[a]);
        const double d2 = d1 + grid.distance(a, end == 0 ? face[a] + 1 : c[a]);
        net += viscosity * area * (v(i, j, k) * d2 * d2 - v.view()(inner) * d1 * d1) / (d1 * d2 * (d2 - d1));
      }
    }
    result(i, j, k) += tau / grid.volume(i, j, k) * net;
  });
  return result;
}

TEST(LineFactors, UndoTheProductOfConvectionAndDiffusionAlongTheAxes)
{
  const grid::Grid grid(
      MPI_COMM_SELF,
      {test::stretched_faces(0, 1, 9, 0.4), test::stretched_faces(0, 2, 7, -0.3), test::stretched_faces(0, 1, 6, 0.2)},
      {false, true, false});
  Field3<double> U = make_field3<double>(grid.owned());
  Field3<double> v = make_field3<double>(grid.owned());
  for (int a = 0; a < 3; ++a) {
    for_each_cell_in_order(grid.owned().faces(a), [&](int i, int j, int k) {
      U[a](i, j, k) = 0.02 * std::sin(1.0 + a + 2 * i + 3 * j + 5 * k);
    });
    for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) { v[a](i, j, k) = std::cos(i + 2 * j + 3 * k + a); });
  }
  Field3<double> r = make_field3<double>(grid.owned());
  for (int d = 0; d < 3; ++d)
    r[d] = factor(grid, 0, U, factor(grid, 1, U, factor(grid, 2, U, v[d])));

  LineFactors factors(grid, holds);
  factors.update(tau, views(std::as_const(U)), viscosity);
  factors.solve(views(r));
  for (int d = 0; d < 3; ++d)
    for_each_cell_in_order(grid.owned(),
                           [&](int i, int j, int k) { EXPECT_NEAR(r[d](i, j, k), v[d](i, j, k), 1e-12); });
}

}  // namespace
}  // namespace luff::operators

// SPDX-License-Identifier: BSD-3-Clause
// A plate without end that moves along its normal with the fluid around and drags it along: Stokes's first problem in a
// frame that passes over the cells.
#include <iostream>
#include <numbers>

#include <gtest/gtest.h>

#include "parallel/vector_field.hpp"
#include "support/flow.hpp"
#include "surface/generators.hpp"

namespace luff::test {
namespace {

constexpr double viscosity = 0.05;
constexpr double age = 0.5;  // of the layer at t = 0
constexpr double width = 4.0;

/// The plane x + y = c, or x = c, in a periodic box two cells deep; the plate moves along its normal and along z.
struct PassingPlate {
  bool oblique;
  double speed;
  double h;

  [[nodiscard]] Vec3 normal() const { return oblique ? Vec3(1.0, 1.0, 0.0).normalized() : Vec3(Vec3::UnitX()); }
  [[nodiscard]] double depth() const { return 2.0 * h; }
  [[nodiscard]] double area() const { return normal().sum() * width * depth(); }
  /// Where the plate meets the edge y = 0.
  [[nodiscard]] double place(double t) const { return 1.0 + 0.37 * h + normal().sum() * speed * t; }
  [[nodiscard]] Vec3 velocity() const { return speed * normal() + Vec3::UnitZ(); }
  [[nodiscard]] double exact(const Vec3& x, double t) const
  {
    const double along = oblique ? x[0] + x[1] : x[0];
    const double distance = std::remainder(along - place(t), width) / normal().sum();
    return std::erfc(std::abs(distance) / std::sqrt(4.0 * viscosity * (t + age)));
  }
  /// Traction on either side.
  [[nodiscard]] static double exact_friction(double t) { return std::sqrt(viscosity / (std::numbers::pi * (t + age))); }

  [[nodiscard]] immersed::SheetMotion motion(double t) const
  {
    const double c = place(t);
    immersed::SheetMotion sheet;
    const auto add = [&](const Vec3& from, const Vec3& to) {
      const surface::TriangleMesh part =
          surface::rectangle({.origin = from, .a = to - from, .b = depth() * Vec3::UnitZ(), .divisions = {20, 1}});
      const int first = static_cast<int>(sheet.position.size());
      sheet.position.insert(sheet.position.end(), part.vertices.begin(), part.vertices.end());
      for (const auto& [p, q, r] : part.triangles)
        sheet.triangles.push_back({first + p, first + q, first + r});
    };
    if (oblique) {
      add({c, 0.0, 0.0}, {0.0, c, 0.0});
      add({width, c, 0.0}, {c, width, 0.0});
    } else {
      add({c, 0.0, 0.0}, {c, width, 0.0});
    }
    sheet.velocity.assign(sheet.position.size(), velocity());
    sheet.acceleration.assign(sheet.position.size(), Vec3::Zero());
    return sheet;
  }
};

/// Means over the last half of a run of one unit of time, as parts of the exact values.
struct Drag {
  double ahead = 0.0, behind = 0.0;       ///< friction on the side that the plate moves to, and on the other
  double by_friction = 0.0, fluid = 0.0;  ///< momentum given away by the plate, taken up by the fluid
};

Drag drag_of(const PassingPlate& plate, double dt)
{
  const std::vector<double> faces = stretched_faces(0.0, width, static_cast<int>(std::lround(width / plate.h)), 0.0);
  TestFlow flow({faces, faces, stretched_faces(0.0, plate.depth(), 2, 0.0)}, sides_of({true, true, true}, {}),
                {.viscosity = viscosity});
  flow.solver.start({.value = [&](const Vec3& x, double t) -> Vec3 {
                      return plate.speed * plate.normal() + plate.exact(x, t) * Vec3::UnitZ();
                    }},
                    0.0);
  const auto momentum = [&] {
    double sum = 0.0;
    for_each_cell_in_order(flow.grid.owned(), [&, w = flow.solver.state().u[2].view()](int i, int j, int k) {
      sum += flow.grid.volume(i, j, k) * w(i, j, k);
    });
    return sum / plate.area();
  };
  const int steps = static_cast<int>(std::lround(1.0 / dt));
  Drag drag;
  double start = 0.0;
  for (int n = 1; n <= steps; ++n) {
    flow.step(dt, plate.motion(flow.t + dt));
    flow.solver.accept();
    if (2 * n == steps)
      start = momentum();
    if (2 * n <= steps)
      continue;
    const immersed::SheetLoads loads = flow.solver.loads();
    const double exact = -PassingPlate::exact_friction(flow.t) * plate.area() * 0.5 * steps;
    for (std::size_t v = 0; v < loads.plus.size(); ++v) {
      drag.ahead += loads.plus[v][2] / exact;
      drag.behind += loads.minus[v][2] / exact;
      drag.by_friction -= dt * loads.force(v)[2] / plate.area();
    }
  }
  const double taken = 4.0 * std::sqrt(viscosity / std::numbers::pi) * (std::sqrt(1.0 + age) - std::sqrt(0.5 + age));
  drag.fluid = (momentum() - start) / taken;
  drag.by_friction /= taken;
  return drag;
}

class PlateThatPassesOverTheGrid : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(StraightAndOblique, PlateThatPassesOverTheGrid, ::testing::Bool());

TEST_P(PlateThatPassesOverTheGrid, FeelsTheFrictionOfOneAtRest)
{
  const Drag at_rest = drag_of({GetParam(), 0.0, 1.0 / 16}, 1.0 / 160);
  const Drag moving = drag_of({GetParam(), 1.0, 1.0 / 16}, 1.0 / 160);
  for (const auto& [name, drag] : {std::pair("at rest", at_rest), std::pair("moving a tenth of a cell a step", moving)})
    std::cout << "  " << name << ": friction ahead " << drag.ahead << ", behind " << drag.behind << "; momentum given "
              << drag.by_friction << ", taken up " << drag.fluid << " of the exact\n";
  EXPECT_NEAR(at_rest.ahead, 1.0, 0.002);
  EXPECT_NEAR(at_rest.behind, 1.0, 0.002);
  // .85 and 1.15 where the stencils of a whole step see the sheet at its end.
  EXPECT_NEAR(moving.ahead, 1.0, 0.07);
  EXPECT_NEAR(moving.behind, 1.0, 0.14);
  EXPECT_NEAR(moving.by_friction, moving.fluid, 0.04);
  EXPECT_NEAR(moving.fluid, 1.0, 0.005);
}

}  // namespace
}  // namespace luff::test

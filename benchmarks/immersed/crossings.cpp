// SPDX-License-Identifier: BSD-3-Clause
// Time to find the crossings of 10^4 triangles of about the size of a cell on 10^6 cells.
#include "immersed/crossings.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/core.h>

#include "support/surfaces.hpp"

using namespace luff;

namespace {

constexpr int cells = 100;
constexpr double middle = 0.505;  // the centre of cell 50

grid::Grid unit_cube()
{
  std::vector<double> faces(cells + 1);
  for (int i = 0; i <= cells; ++i)
    faces[i] = 0.01 * i;
  return {MPI_COMM_SELF, {faces, faces, faces}, {false, false, false}};
}

test::TriangleMesh wavy_sheet(const Mat3& turn)
{
  return test::mapped(test::sheet(71), [&](const Vec3& x) {
    const Vec3 wave(0.355 * x[0], 0.355 * x[1], 0.05 * std::sin(3.0 * x[0]));
    return Vec3(Vec3::Constant(middle) + turn * wave);
  });
}

/// Vertices on centres, so that every test along x and y is a tie.
test::TriangleMesh sheet_on_centres(const grid::Grid& grid, double slope)
{
  return test::mapped(test::sheet(71), [&](const Vec3& x) {
    const auto centre = [&](int axis, double at) {
      return grid.centre(axis, 50 + static_cast<int>(std::lround(35.5 * at)));
    };
    return Vec3(centre(0, x[0]), centre(1, x[1]), centre(2, slope * x[0]));
  });
}

/// Best of 50 runs: what the work itself costs.
void time(const char* name, const grid::Grid& grid, const test::TriangleMesh& mesh)
{
  using clock = std::chrono::steady_clock;
  double best = 1e9;
  std::size_t hits = 0;
  for (int run = 0; run < 50; ++run) {
    const auto start = clock::now();
    hits = immersed::find_crossings(grid, mesh.vertices, mesh.triangles).size();
    best = std::min(best, std::chrono::duration<double, std::milli>(clock::now() - start).count());
  }
  fmt::print("{:<36}{:>12}{:>10}{:>10.2f}\n", name, mesh.n_triangles(), hits, best);
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  {
    const grid::Grid grid = unit_cube();
    fmt::print("{:<36}{:>12}{:>10}{:>10}\n", "on 10^6 cells", "triangles", "hits", "ms");
    time("wavy sheet, along the grid", grid, wavy_sheet(Mat3::Identity()));
    time("wavy sheet, turned", grid, wavy_sheet(test::Chance(1).turn()));
    time("flat sheet, vertices on centres", grid, sheet_on_centres(grid, 0.0));
    time("at 45 degrees, vertices on centres", grid, sheet_on_centres(grid, 1.0));
    time("sphere", grid,
         test::mapped(test::sphere(5), [](const Vec3& x) { return Vec3(Vec3::Constant(middle) + 0.4 * x); }));
  }
  MPI_Finalize();
}

// SPDX-License-Identifier: BSD-3-Clause
// Time to find the crossings of 10^4 triangles of about the size of a cell on 10^6 cells, with grid lines along the
// axes and with links of any direction.
#include "immersed/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/core.h>

#include "support/links.hpp"
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

double cpu_milliseconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Best of 50 runs: what the work itself costs.  find(mesh) gives the crossings.
template <class Find>
void time(const char* name, const test::TriangleMesh& mesh, Find find)
{
  double best = 1e9;
  std::size_t hits = 0;
  for (int run = 0; run < 50; ++run) {
    const double start = cpu_milliseconds();
    hits = find(mesh).size();
    best = std::min(best, cpu_milliseconds() - start);
  }
  fmt::print("{:<36}{:>12}{:>10}{:>10.2f}\n", name, mesh.n_triangles(), hits, best);
}

template <class Find>
void time_all(const char* title, const grid::Grid& grid, Find find)
{
  fmt::print("{:<36}{:>12}{:>10}{:>10}\n", title, "triangles", "hits", "CPU ms");
  time("  wavy sheet, along the grid", wavy_sheet(Mat3::Identity()), find);
  time("  wavy sheet, turned", wavy_sheet(test::Chance(1).turn()), find);
  time("  flat sheet, vertices on centres", sheet_on_centres(grid, 0.0), find);
  time("  at 45 degrees, vertices on centres", sheet_on_centres(grid, 1.0), find);
  time("  sphere", test::mapped(test::sphere(5), [](const Vec3& x) { return Vec3(Vec3::Constant(middle) + 0.4 * x); }),
       find);
}

}  // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  {
    const grid::Grid grid = unit_cube();
    fmt::print("10^6 cells\n");
    time_all("grid lines along the axes", grid, [&](const test::TriangleMesh& mesh) {
      return immersed::find_crossings(grid, mesh.vertices, mesh.triangles);
    });
    const auto on_links = [&](const char* title, const test::Centres& centre) {
      const test::Links links(MPI_COMM_SELF, grid.cells(), {false, false, false}, centre);
      time_all(title, grid, [&](const test::TriangleMesh& mesh) { return links.crossings(mesh); });
    };
    on_links("the same as links of any direction",
             [&](const Index3& c) -> Vec3 { return grid.centre(c[0], c[1], c[2]); });
    on_links("links of a sheared, bent grid", [&](const Index3& c) -> Vec3 {
      const Vec3 x = grid.centre(c[0], c[1], c[2]);
      return {x[0] + 0.5 * (x[1] - middle), x[1] + 0.05 * std::sin(5.0 * x[0]), x[2] + 0.05 * std::cos(5.0 * x[1])};
    });
  }
  MPI_Finalize();
}

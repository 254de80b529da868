// SPDX-License-Identifier: BSD-3-Clause
// Grids, sheets and fluxes on which projections are tested, the same for any number of ranks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "parallel/halo.hpp"
#include "poisson/pressure_solver.hpp"

namespace luff::poisson::test {

/// n cells over [0, length], the widest `ratio` times the narrowest, which lie around `centre`.
inline std::vector<double> faces(int n, double length, double ratio = 1.0, double centre = 0.45)
{
  std::vector<double> h(n);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = std::abs((i + 0.5) / n - centre) / std::max(centre, 1.0 - centre);
    sum += h[i] = std::pow(ratio, std::min(1.0, 1.3 * s));
  }
  std::vector<double> x(n + 1, 0.0);
  for (int i = 0; i < n; ++i)
    x[i + 1] = x[i] + length * h[i] / sum;
  return x;
}

struct Problem {
  Index3 cells{16, 16, 16};
  double ratio = 1.0;            ///< widest over narrowest cell
  std::string sides = "NNNNNN";  ///< x low, x high, y low, ...: Neumann, Dirichlet, Periodic (both of an axis)
  double length = 1.0;
  MPI_Comm comm = MPI_COMM_SELF;

  [[nodiscard]] bool periodic(int axis) const { return sides[2 * axis] == 'P'; }
  [[nodiscard]] grid::Grid grid() const
  {
    std::array<std::vector<double>, 3> lines;
    for (int a = 0; a < 3; ++a)
      lines[a] = faces(cells[a], length * cells[a] / *std::max_element(cells.begin(), cells.end()), ratio);
    return {comm, lines, {periodic(0), periodic(1), periodic(2)}};
  }
  [[nodiscard]] SideConditions conditions() const
  {
    SideConditions conditions;
    for (int a = 0; a < 3; ++a)
      for (int s = 0; s < 2; ++s)
        conditions[a][s] = sides[2 * a + s] == 'D' ? SideCondition::Dirichlet : SideCondition::Neumann;
    return conditions;
  }
};

using Point = std::array<double, 3>;
/// True when a sheet cuts the link between two cell centres, given in units of the lengths of the domain.
using Cuts = std::function<bool(const Point&, const Point&)>;

inline bool no_sheet(const Point&, const Point&)
{
  return false;
}
/// A curved flag over part of the domain.
inline bool flag(const Point& a, const Point& b)
{
  const auto above = [](const Point& x) {
    const double s = (x[0] - 0.3) / 0.4;
    return x[1] > 0.38 + 0.14 * s + 0.10 * s * s + 0.04 * std::sin(6.0 * x[2]);
  };
  const double x = 0.5 * (a[0] + b[0]);
  const double z = 0.5 * (a[2] + b[2]);
  return above(a) != above(b) && x > 0.3 && x < 0.7 && z > 0.25 && z < 0.75;
}
/// A closed box: two components.
inline bool closed_box(const Point& a, const Point& b)
{
  const auto inside = [](const Point& x) {
    return std::abs(x[0] - 0.47) < 0.2 && std::abs(x[1] - 0.5) < 0.21 && std::abs(x[2] - 0.5) < 0.2;
  };
  return inside(a) != inside(b);
}
/// A wall across the domain with a hole of radius `hole` around the axis.
inline Cuts orifice(double hole)
{
  return [hole](const Point& a, const Point& b) {
    const double r = std::hypot(0.5 * (a[1] + b[1]) - 0.5, 0.5 * (a[2] + b[2]) - 0.5);
    return (a[0] < 0.46) != (b[0] < 0.46) && r > hole;
  };
}

template <class Visit>
void for_faces(const grid::Grid& grid, Visit visit)
{
  for (int a = 0; a < 3; ++a) {
    const IndexBox box = grid.owned().faces(a);
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        for (int i = box.lo[0]; i < box.hi[0]; ++i)
          visit(FaceIndex{a, {i, j, k}});
  }
}

inline bool on_side(const grid::Grid& grid, const FaceIndex& f)
{
  const int i = f.cell[f.axis];
  return !grid.ranks().periodic(f.axis) && (i == 0 || i == grid.cells()[f.axis]);
}

inline std::vector<FaceIndex> blocked(const grid::Grid& grid, const Cuts& cuts)
{
  std::vector<FaceIndex> result;
  for_faces(grid, [&](const FaceIndex& f) {
    if (on_side(grid, f))
      return;
    Point low, high;
    for (int a = 0; a < 3; ++a) {
      const int i = f.cell[a];
      high[a] = (grid.centre(a, i) - grid.face(a, 0)) / grid.length(a);
      low[a] = (grid.centre(a, a == f.axis ? i - 1 : i) - grid.face(a, 0)) / grid.length(a);
    }
    if (cuts(low, high))
      result.push_back(f);
  });
  return result;
}

/// A number in [-1, 1) that depends on the face alone; periodic copies of a face agree.
inline double noise(const grid::Grid& grid, const FaceIndex& f)
{
  std::uint64_t h = f.axis + 1;
  for (int a = 0; a < 3; ++a)
    h = (h ^
         static_cast<std::uint64_t>(f.cell[a] % (grid.ranks().periodic(a) ? grid.cells()[a] : grid.cells()[a] + 1))) *
        0x9E3779B97F4A7C15ull;
  h ^= h >> 29;
  h *= 0xBF58476D1CE4E5B9ull;
  h ^= h >> 32;
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

/// Random velocities of order one times areas; nothing through closed sides and blocked faces.
inline void set_random_fluxes(const Problem& problem, const grid::Grid& grid, const std::vector<FaceIndex>& closed,
                              Field3<double>& U, double speed = 1.0)
{
  for_faces(grid, [&](const FaceIndex& f) {
    Index3 c = f.cell;
    for (int a = 0; a < 3; ++a)
      c[a] = std::min(c[a], grid.cells()[a] - 1);
    const bool wall = on_side(grid, f) && problem.sides[2 * f.axis + (f.cell[f.axis] == 0 ? 0 : 1)] == 'N';
    U[f.axis](f.cell[0], f.cell[1], f.cell[2]) =
        wall ? 0.0 : speed * noise(grid, f) * grid.area(f.axis, c[0], c[1], c[2]);
  });
  for (const FaceIndex& f : closed)
    U[f.axis](f.cell[0], f.cell[1], f.cell[2]) = 0.0;
}

struct Projection {
  Field3<double> U;
  Field<double> p;
  Report report;
};

inline Projection project(const Problem& problem, const grid::Grid& grid, const Cuts& cuts, const Target& target,
                          const std::string& kind = "multigrid", double speed = 1.0)
{
  Projection result{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
  const std::vector<FaceIndex> closed = blocked(grid, cuts);
  set_random_fluxes(problem, grid, closed, result.U, speed);
  const auto solver = make_pressure_solver(grid, problem.conditions(), {kind});
  solver->set_blocked(closed);
  result.report = solver->project(views(result.U), result.p.view(), 0.1, target);
  return result;
}

/// max over owned cells of |net outflow| h / (V speed), summed afresh from the fluxes.
inline double divergence(const grid::Grid& grid, const Field3<double>& U, double speed = 1.0)
{
  const IndexBox& box = grid.owned();
  double largest = 0.0;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i) {
        const double net =
            U[0](i + 1, j, k) - U[0](i, j, k) + U[1](i, j + 1, k) - U[1](i, j, k) + U[2](i, j, k + 1) - U[2](i, j, k);
        const double h = std::min({grid.width(0, i), grid.width(1, j), grid.width(2, k)});
        largest = std::max(largest, std::abs(net) * h / (grid.volume(i, j, k) * speed));
      }
  return grid.ranks().max(largest);
}

/// Largest difference of two fields over owned cells.
inline double difference(const grid::Grid& grid, const Field<double>& a, const Field<double>& b)
{
  const auto u = a.view();
  const auto v = b.view();
  return grid.ranks().max(
      max_cells(grid.owned(), [&](int i, int j, int k) { return std::abs(u(i, j, k) - v(i, j, k)); }));
}
inline double largest(const grid::Grid& grid, const Field<double>& a)
{
  return difference(grid, a, Field<double>(grid.owned()));
}

inline const Target tight{.relative = 0.0, .divergence = 5e-14, .speed = 1.0, .max_iterations = 100};

struct NamedCase {
  std::string name;
  Problem problem;
  Cuts cuts;
};

}  // namespace luff::poisson::test

// SPDX-License-Identifier: BSD-3-Clause
// Curvilinear grids, sheets on them and projections, the same for any number of ranks.
#pragma once

#include <numbers>

#include "cases.hpp"
#include "support/curvilinear.hpp"

namespace luff::poisson::test {

/// Grid lines slide along the sides of the unit cube and along the plane y = 1/2, so that they meet them at an angle.
struct Slid {
  double amplitude = 0.12;
  Vec3 operator()(const Vec3& s) const
  {
    using std::numbers::pi;
    const double x = s[0] + amplitude * std::sin(pi * s[0]) * std::sin(2.0 * pi * (s[1] - 0.2));
    const double y = s[1] + 0.25 * amplitude * std::sin(2.0 * pi * s[1]) * std::cos(pi * s[0] + 1.0);
    const double z = s[2] + 0.5 * amplitude * std::sin(pi * s[2]) * std::sin(2.0 * pi * (s[0] + 0.3));
    return {x, y, z};
  }
};

/// A quarter of a bent pipe whose square section is rounded by `roundness`; left-handed.
struct BentPipe {
  double roundness = 0.6;
  Vec3 operator()(const Vec3& s) const
  {
    const double a = 2.0 * s[1] - 1.0;
    const double c = 2.0 * s[2] - 1.0;
    const double u = a * (1.0 - roundness + roundness * std::sqrt(1.0 - 0.5 * c * c));
    const double v = c * (1.0 - roundness + roundness * std::sqrt(1.0 - 0.5 * a * a));
    const double angle = 0.5 * std::numbers::pi * s[0];
    return {(3.0 + u) * std::sin(angle), (3.0 + u) * std::cos(angle), v};
  }
};

/// A ring around the z axis, closed along the first direction.
struct Ring {
  Vec3 operator()(const Vec3& s) const
  {
    using std::numbers::pi;
    const double angle = 2.0 * pi * s[0] + 0.4 * s[1];
    const double r = 1.0 + s[1];
    return {r * std::cos(angle), r * std::sin(angle), s[2] + 0.1 * s[1]};
  }
};

using Map = std::function<Vec3(const Vec3&)>;

struct CurvilinearProblem {
  Index3 cells{16, 16, 16};
  Map map = Slid{};
  std::string sides = "NNNNNN";
  MPI_Comm comm = MPI_COMM_SELF;

  [[nodiscard]] bool periodic(int axis) const { return sides[2 * axis] == 'P'; }
  [[nodiscard]] grid::Grid grid() const
  {
    return {comm, cells, luff::test::mapped_nodes(cells, map), {periodic(0), periodic(1), periodic(2)}};
  }
  [[nodiscard]] SideConditions conditions() const { return Problem{cells, 1.0, sides}.conditions(); }
};

/// What cuts links; `in_part`: half of the faces let a part of the flow through, the same on any number of ranks.
struct Sheet {
  Sheet(std::convertible_to<Cuts> auto links, bool partly = false) : cuts(links), in_part(partly) {}
  Cuts cuts;
  bool in_part;
};

inline void open_in_part(const grid::Grid& grid, std::vector<FaceIndex>& faces)
{
  for (FaceIndex& f : faces)
    f.open = 0.99 * std::max(0.0, noise(grid, f));
}

/// Faces whose link between centres a sheet cuts, given in relative indices.
inline std::vector<FaceIndex> blocked_links(const grid::Grid& grid, const Sheet& sheet)
{
  std::vector<FaceIndex> result;
  for_faces(grid, [&](const FaceIndex& f) {
    if (on_side(grid, f))
      return;
    Point low, high;
    for (int a = 0; a < 3; ++a) {
      high[a] = (f.cell[a] + 0.5) / grid.cells()[a];
      low[a] = high[a] - (a == f.axis ? 1.0 / grid.cells()[a] : 0.0);
    }
    if (sheet.cuts(low, high))
      result.push_back(f);
  });
  if (sheet.in_part)
    open_in_part(grid, result);
  return result;
}

/// Random fluxes; nothing through closed sides and faces.
inline void set_random_fluxes(const CurvilinearProblem& problem, const grid::Grid& grid,
                              const std::vector<FaceIndex>& closed, Field3<double>& U)
{
  const double area = grid.smallest_width() * grid.smallest_width();
  for_faces(grid, [&](const FaceIndex& f) {
    const bool wall = on_side(grid, f) && problem.sides[2 * f.axis + (f.cell[f.axis] == 0 ? 0 : 1)] == 'N';
    U[f.axis].view()(f.cell) = wall ? 0.0 : area * noise(grid, f);
  });
  for (const FaceIndex& f : closed)
    if (f.open == 0.0)
      U[f.axis].view()(f.cell) = 0.0;
}

inline Projection project(const CurvilinearProblem& problem, const grid::Grid& grid, const Sheet& sheet,
                          const Target& target)
{
  Projection result{make_field3<double>(grid.owned()), Field<double>(grid.owned()), {}};
  const std::vector<FaceIndex> closed = blocked_links(grid, sheet);
  set_random_fluxes(problem, grid, closed, result.U);
  const auto solver = make_pressure_solver(grid, problem.conditions());
  solver->set_blocked(closed);
  result.report = solver->project(views(result.U), result.p.view(), 0.1, target);
  return result;
}

/// max over owned cells of |net outflow| / S, S the largest of the areas of the cell's faces.
inline double curvilinear_divergence(const grid::Grid& grid, const Field3<double>& U)
{
  double largest = 0.0;
  for_each_cell_in_order(grid.owned(), [&](int i, int j, int k) {
    double net = 0.0;
    double area = 0.0;
    for (int a = 0; a < 3; ++a) {
      const Index3 high = stepped({i, j, k}, a, 1);
      net += U[a].view()(high) - U[a](i, j, k);
      area = std::max({area, grid.area(a, i, j, k), grid.area(a, high[0], high[1], high[2])});
    }
    largest = std::max(largest, std::abs(net) / area);
  });
  return grid.ranks().max(largest);
}

struct NamedCurvilinearCase {
  std::string name;
  CurvilinearProblem problem;
  Sheet sheet;
};

inline std::vector<NamedCurvilinearCase> curvilinear_cases()
{
  return {
      {"slid box", {{16, 17, 19}, Slid{}}, no_sheet},
      {"slid box, outflow, flag", {{24, 20, 18}, Slid{}, "NDNNNN"}, flag},
      {"left-handed", {{18, 20, 17}, luff::test::Mirrored<Slid>{}, "NNDNNN"}, flag},
      {"bent pipe, orifice", {{30, 20, 22}, BentPipe{}, "NDNNNN"}, orifice(0.1)},
      {"bent pipe, pressure on both ends", {{30, 24, 18}, BentPipe{}, "DDNNNN"}, flag},
      {"strongly skewed pipe, orifice", {{30, 20, 22}, BentPipe{0.9}, "NDNNNN"}, orifice(0.1)},
      {"strongly skewed, left-handed, flag", {{20, 22, 18}, luff::test::Mirrored<Slid>{{0.25}}}, flag},
      {"waved, periodic, odd", {{15, 13, 9}, luff::test::Waved{}, "PPPPPP"}, no_sheet},
      {"waved, partly periodic, flag", {{25, 16, 21}, luff::test::Waved{}, "NDPPPP"}, flag},
      {"ring", {{32, 12, 10}, Ring{}, "PPNNND"}, flag},
      {"closed box inside", {{20, 20, 20}, Slid{}}, closed_box},
      {"flag open in part", {{24, 20, 18}, Slid{}, "NDNNNN"}, {flag, true}},
      {"left-handed, open in part", {{18, 20, 17}, luff::test::Mirrored<Slid>{}, "NNDNNN"}, {flag, true}},
      {"strongly skewed pipe, orifice open in part", {{30, 20, 22}, BentPipe{0.9}, "NDNNNN"}, {orifice(0.1), true}},
      {"waved, all periodic, open in part", {{15, 13, 9}, luff::test::Waved{}, "PPPPPP"}, {orifice(0.1), true}},
      {"ring, all of a wall open in part", {{32, 12, 10}, Ring{}, "PPNNND"}, {orifice(-1.0), true}},
      {"slab of one cell, open in part", {{24, 20, 1}, luff::test::Waved{}, "NDNNPP"}, {flag, true}},
      {"slab of one cell", {{24, 20, 1}, Slid{}, "NDNNNN"}, flag},
      {"periodic slab of one cell", {{24, 20, 1}, luff::test::Waved{}, "NDNNPP"}, flag},
  };
}

}  // namespace luff::poisson::test

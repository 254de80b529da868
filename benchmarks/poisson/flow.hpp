// SPDX-License-Identifier: BSD-3-Clause
// Grids, sheets and fluxes for benchmarks of the projection.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "poisson/pressure_solver.hpp"

namespace luff::benchmark {

using poisson::FaceIndex;

inline double thread_time()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// n cells over [0, length], the widest `ratio` times the narrowest.
inline std::vector<double> faces(int n, double length, double ratio, double centre)
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

/// True for links that three leaflets cut: a dome across the whole section, with gaps three cells wide between them
/// that form a Y.  Cells by their relative indices.
inline bool cut_by_valve(const Index3& cells, const Index3& low, const Index3& high)
{
  const auto part = [&](int a, const Index3& c) { return (c[a] + 0.5) / cells[a]; };
  const auto behind = [&](const Index3& c) {
    const double r = std::hypot(part(1, c) - 0.5, part(2, c) - 0.5);
    return part(0, c) > 0.35 + 0.22 * (1.0 - 2.0 * r);
  };
  const auto in_gap = [&](const Index3& c) {
    const double y = 2.0 * part(1, c) - 1.0;
    const double z = 2.0 * part(2, c) - 1.0;
    for (int ray = 0; ray < 3; ++ray) {
      const double angle = 2.0 * std::numbers::pi / 3.0 * ray + 0.3;
      const double along = y * std::cos(angle) + z * std::sin(angle);
      const double across = std::abs(-y * std::sin(angle) + z * std::cos(angle));
      if (along > -0.05 && along < 0.7 && across < 3.0 / cells[1])
        return true;
    }
    return false;
  };
  return behind(high) != behind(low) && !in_gap(high) && !in_gap(low);
}

/// Faces whose link between centres a sheet cuts.
template <class Cut>
std::vector<FaceIndex> blocked_faces(const Index3& cells, Cut cut)
{
  std::vector<FaceIndex> faces;
  for (int a = 0; a < 3; ++a)
    for_each_cell_in_order({{0, 0, 0}, cells}, [&](int i, int j, int k) {
      const Index3 c{i, j, k};
      if (c[a] > 0 && cut(stepped(c, a, -1), c))
        faces.push_back({a, c});
    });
  return faces;
}

enum class Sheet { None, Flag, Valve };

struct Case {
  std::string name;
  Index3 cells;
  double ratio;
  Sheet sheet;
  bool outflow;
};

struct Flow {
  explicit Flow(const Case& c)
      : grid(MPI_COMM_SELF,
             {faces(c.cells[0], static_cast<double>(c.cells[0]) / c.cells[1], c.ratio, 0.4),
              faces(c.cells[1], 1.0, c.ratio, 0.5),
              faces(c.cells[2], static_cast<double>(c.cells[2]) / c.cells[1], c.ratio, 0.5)},
             {false, false, false}),
        U(make_field3<double>(grid.owned()))
  {
    using poisson::SideCondition;
    for (auto& axis : sides)
      axis = {SideCondition::Neumann, SideCondition::Neumann};
    if (c.outflow)
      sides[0][1] = SideCondition::Dirichlet;
    set_fluxes(c.outflow);
    if (c.sheet == Sheet::Flag)
      block([this](const Index3& low, const Index3& high) { return cut_by_flag(low, high); });
    if (c.sheet == Sheet::Valve)
      block([this](const Index3& low, const Index3& high) { return cut_by_valve(grid.cells(), low, high); });
  }

  /// Large eddies with five per cent of noise.
  void set_fluxes(bool outflow)
  {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int a = 0; a < 3; ++a)
      for_faces(a, [&](const Index3& c) {
        const double x = 6.0 * c[0] / grid.cells()[0];
        const double y = 6.0 * c[1] / grid.cells()[1];
        const double z = 6.0 * c[2] / grid.cells()[2];
        const double eddy = a == 0   ? 1.0 + 0.3 * std::sin(y + 0.5 * z + x)
                            : a == 1 ? 0.4 * std::cos(x + 0.7 * z + 0.5 * y)
                                     : 0.4 * std::sin(x - 0.8 * y + 0.6 * z);
        const bool side = c[a] == 0 || c[a] == grid.cells()[a];
        const bool closed = side && !(outflow && a == 0 && c[0] > 0);
        Index3 inner = c;
        for (int d = 0; d < 3; ++d)
          inner[d] = std::min(c[d], grid.cells()[d] - 1);
        U[a](c[0], c[1], c[2]) =
            closed ? 0.0 : (eddy + 0.05 * uniform(random)) * grid.area(a, inner[0], inner[1], inner[2]);
      });
  }

  /// Place of a centre in units of the domain's lengths.
  [[nodiscard]] double part(int a, int i) const { return (grid.centre(a, i) - grid.face(a, 0)) / grid.length(a); }

  /// A curved flag that covers 40 % of the length and half of the width.
  [[nodiscard]] bool cut_by_flag(const Index3& low, const Index3& high) const
  {
    const auto above = [&](const Index3& c) {
      const double s = (part(0, c[0]) - 0.3) / 0.4;
      return part(1, c[1]) > 0.38 + 0.14 * s + 0.10 * s * s + 0.04 * std::sin(6.0 * part(2, c[2]));
    };
    const double x = 0.5 * (part(0, high[0]) + part(0, low[0]));
    const double z = 0.5 * (part(2, high[2]) + part(2, low[2]));
    return above(high) != above(low) && x > 0.3 && x < 0.7 && z > 0.25 && z < 0.75;
  }

  template <class Cut>
  void block(Cut cut)
  {
    blocked = blocked_faces(grid.cells(), cut);
    for (const FaceIndex& f : blocked)
      U[f.axis].view()(f.cell) = 0.0;
  }

  template <class Visit>
  void for_faces(int axis, Visit visit) const
  {
    const IndexBox box = grid.owned().faces(axis);
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j)
        for (int i = box.lo[0]; i < box.hi[0]; ++i)
          visit(Index3{i, j, k});
  }

  /// A/d of a face without the sheet.
  [[nodiscard]] double conductance(int a, const Index3& f) const
  {
    const int n = grid.cells()[a];
    Index3 inner = f;
    inner[a] = std::min(f[a], n - 1);
    const double area = grid.area(a, inner[0], inner[1], inner[2]);
    if (f[a] > 0 && f[a] < n)
      return area / grid.distance(a, f[a]);
    const bool open = sides[a][f[a] == 0 ? 0 : 1] == poisson::SideCondition::Dirichlet;
    return open ? area / (0.5 * grid.width(a, inner[a])) : 0.0;
  }

  /// Of all faces, 0 where closed.
  [[nodiscard]] Field3<double> conductances() const
  {
    Field3<double> c = make_field3<double>(grid.owned());
    for (int a = 0; a < 3; ++a)
      for_faces(a, [&](const Index3& f) { c[a](f[0], f[1], f[2]) = conductance(a, f); });
    for (const FaceIndex& f : blocked)
      c[f.axis](f.cell[0], f.cell[1], f.cell[2]) = 0.0;
    return c;
  }

  grid::Grid grid;
  poisson::SideConditions sides{};
  Field3<double> U;
  std::vector<FaceIndex> blocked;
};

}  // namespace luff::benchmark

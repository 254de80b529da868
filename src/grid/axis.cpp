// SPDX-License-Identifier: BSD-3-Clause
#include "grid/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace luff::grid {

namespace {

/// Sum of n widths h r, h r^2, ..., h r^n.
double geometric_length(double h, double r, int n)
{
  double width = h;
  double length = 0.0;
  for (int i = 0; i < n; ++i)
    length += width *= r;
  return length;
}

/// The ratio r with geometric_length(h, r, n) = length, by bisection.
double growth_ratio(double h, double length, int n)
{
  double low = 0.0;
  double high = 2.0;
  while (geometric_length(h, high, n) < length)
    high *= 2.0;
  for (int it = 0; it < 200 && high - low > 0.0; ++it) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high)
      break;
    (geometric_length(h, middle, n) < length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> uniform_faces(const AxisSpec& spec)
{
  std::vector<double> x(spec.cells + 1);
  for (int i = 0; i <= spec.cells; ++i)
    x[i] = spec.from + (spec.to - spec.from) * i / spec.cells;
  return x;
}

struct Sides {
  int low = 0;   ///< cells below the refined stretch
  int high = 0;  ///< cells above it
  double low_ratio = 1.0;
  double high_ratio = 1.0;
};

double ratio_of_side(double h, double length, int n)
{
  // A side shorter than a thousandth of a cell is no side.
  if (length <= 1e-3 * h)
    return n == 0 ? 1.0 : std::numeric_limits<double>::infinity();
  return n == 0 ? std::numeric_limits<double>::infinity() : growth_ratio(h, length, n);
}

/// Shares the cells outside the refined stretch so that both sides grow alike.
Sides share_cells(double h, double low_length, double high_length, int cells)
{
  Sides best;
  double smallest = std::numeric_limits<double>::infinity();
  for (int low = 0; low <= cells; ++low) {
    const double a = ratio_of_side(h, low_length, low);
    const double b = ratio_of_side(h, high_length, cells - low);
    const double worst = std::max(std::max(a, 1.0 / a), std::max(b, 1.0 / b));
    if (worst < smallest) {
      smallest = worst;
      best = {low, cells - low, a, b};
    }
  }
  return best;
}

}  // namespace

std::vector<double> face_coordinates(const AxisSpec& spec, const std::string& name)
{
  if (!(spec.to > spec.from) || spec.cells < 1)
    fail_input("grid.{}: from = {}, to = {}, cells = {}: needs from < to and at least one cell", name, spec.from,
               spec.to, spec.cells);
  if (!spec.refine)
    return uniform_faces(spec);
  const Refinement& r = *spec.refine;
  const int inside = std::max(1, static_cast<int>(std::lround((r.to - r.from) / r.spacing)));
  const double h = (r.to - r.from) / inside;
  const int outside = spec.cells - inside;
  if (outside < 0)
    fail_input("grid.{}.cells = {} must be at least the {} cells that refine = [{}, {}] with spacing {} takes", name,
               spec.cells, inside, r.from, r.to, r.spacing);
  const Sides sides = share_cells(h, r.from - spec.from, spec.to - r.to, outside);
  const double largest = std::max(sides.low_ratio, sides.high_ratio);
  // Width of the outermost cells over the spacing inside.
  const double finest = std::min(std::pow(sides.low_ratio, sides.low), std::pow(sides.high_ratio, sides.high));
  if (!(largest <= largest_growth))
    fail_input(
        "grid.{}.cells = {} is too few: outside the refined stretch each cell would be {:.2f} times its neighbour "
        "(at most {}); give more cells, a coarser spacing or a smaller domain",
        name, spec.cells, largest, largest_growth);
  if (finest < 1.0 / largest_growth)
    fail_input(
        "grid.{}.cells = {} is too many: the cells outside the refined stretch would be finer than inside "
        "({:.2g} of the spacing); give fewer cells or a finer spacing",
        name, spec.cells, finest);

  std::vector<double> x(spec.cells + 1);
  for (int i = 0; i <= inside; ++i)
    x[sides.low + i] = r.from + (r.to - r.from) * i / inside;
  double width = h;
  for (int i = sides.low - 1; i >= 0; --i)
    x[i] = x[i + 1] - (width *= sides.low_ratio);
  width = h;
  for (int i = sides.low + inside + 1; i <= spec.cells; ++i)
    x[i] = x[i - 1] + (width *= sides.high_ratio);
  x.front() = spec.from;
  x.back() = spec.to;
  return x;
}

}  // namespace luff::grid

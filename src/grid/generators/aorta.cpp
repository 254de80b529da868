// SPDX-License-Identifier: BSD-3-Clause
#include "grid/generators/aorta.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grid/generators/pipe.hpp"

namespace luff::grid {

namespace {

using std::numbers::pi;

/// All lengths in mm, of a root whose annulus has this radius.
constexpr double R = 12.7;

// Along the centreline.
constexpr double inlet = aorta_inlet * R;
constexpr double straight_end = 35.0;  // s1
constexpr double ramp = 15.0;          // over which the curvature of the arch comes and goes
constexpr double arch_radius = 32.0;
constexpr double arch_begin = straight_end + ramp;                 // s2
constexpr double arch_end = arch_begin + pi * arch_radius - ramp;  // s3
constexpr double arch_over = arch_end + ramp;                      // s4
constexpr double outlet = arch_over + 80.0;                        // s5
constexpr double half_twist = 12.0 * pi / 180.0;

// The root; sizes within measured ranges, height of the commissures after [thubrikar_1981_design].
constexpr double sinus_height = 1.70 * R;
constexpr double commissure_height = 1.17 * R;
constexpr double crown_height = 0.896 * commissure_height;
constexpr double post_width = 1.6;
constexpr double sinus_depth = 4.2;

/// 0 before 0, 1 after 1, twice differentiable.
double smooth_step(double t)
{
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

Eigen::Vector2d curvature(double s)
{
  const double k = (smooth_step((s - straight_end) / ramp) - smooth_step((s - arch_end) / ramp)) / arch_radius;
  const double beta = 2.0 * half_twist * (smooth_step((s - straight_end) / (arch_over - straight_end)) - 0.5);
  return k * Eigen::Vector2d(std::cos(beta), std::sin(beta));
}

Centreline aorta_centreline()
{
  constexpr int pieces = 20000;
  constexpr double ds = (outlet - inlet) / pieces;
  Centreline line(frame_along({0.0, 0.0, inlet}, Vec3::UnitZ()));
  for (int n = 0; n < pieces; ++n)
    line.add(ds, curvature(inlet + (n + 0.5) * ds));
  return line;
}

/// Radius without the sinuses: tubular, ascending, arch, descending.
double tube_radius(double s)
{
  return R + 1.5 * smooth_step((s - commissure_height) / (sinus_height + 4.0 - commissure_height)) +
         1.3 * smooth_step((s - sinus_height) / (straight_end + 5.0 - sinus_height)) -
         1.9 * smooth_step((s - arch_begin) / (arch_end - arch_begin)) - 1.4 * smooth_step((s - arch_end) / 40.0);
}

/// Height of the crown at an angle: a superellipse between two posts, fitted to [khelil_2015_surgical].
double crown(double theta)
{
  const double psi = pi / 3.0 - std::asin(0.5 * post_width / R);
  const double from_middle = std::abs(std::remainder(theta, 2.0 * pi / 3.0));
  const double q = std::clamp(from_middle / psi, 0.0, 1.0);
  return crown_height * (1.0 - std::pow(1.0 - std::pow(q, 2.08), 1.0 / 2.21));
}

/// The sinuses: 16 t^2 (1 - t)^2 between crown and top, lobed as ((1 + cos 3 theta)/2)^1.25.
double sinus(double s, double theta)
{
  const double foot = crown(theta);
  const double t = std::clamp((s - foot) / (sinus_height - foot), 0.0, 1.0);
  const double lobe = std::pow(0.5 * (1.0 + std::cos(3.0 * theta)), 1.25);
  return sinus_depth * 16.0 * t * t * (1.0 - t) * (1.0 - t) * lobe;
}

}  // namespace

double aorta_outlet()
{
  return outlet / R;
}

CurvilinearNodes make_aorta(const std::vector<double>& stations, int across, double radius)
{
  // The pipe counts its arc length from the inlet.
  std::vector<double> from_inlet;
  for (const double s : stations)
    from_inlet.push_back(s * R - inlet);
  const CurvilinearNodes model = make_pipe({.centreline = aorta_centreline(),
                                            .stations = from_inlet,
                                            .across = across,
                                            .radius = [](double s) { return tube_radius(s + inlet); },
                                            .bulge = [](double s, double theta) { return sinus(s + inlet, theta); }});
  return {model.cells, [source = model.source, scale = radius / R](const IndexBox& box) {
            std::vector<Vec3> nodes = source(box);
            for (Vec3& x : nodes)
              x *= scale;
            return nodes;
          }};
}

}  // namespace luff::grid

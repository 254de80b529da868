// SPDX-License-Identifier: BSD-3-Clause
#include "operators/momentum.hpp"

#include <cmath>

namespace luff::operators {

namespace {

/// Unit step along axis a.
template <int a>
struct Step {
  static constexpr int i = a == 0, j = a == 1, k = a == 2;
};

template <int a>
LUFF_KERNEL int along(int i, int j, int k)
{
  return a == 0 ? i : a == 1 ? j : k;
}

/// Convection and diffusion of one component through the two faces normal to axis a, per volume.
template <int a, class Metric>
LUFF_KERNEL double axis_rate(const Metric& m, const View<const double>& u, const View<const double>& U,
                             double viscosity, double inverse_volume, int i, int j, int k)
{
  using S = Step<a>;
  const int l = along<a>(i, j, k);
  const double u_low = u(i - S::i, j - S::j, k - S::k);
  const double u_here = u(i, j, k);
  const double u_high = u(i + S::i, j + S::j, k + S::k);
  const double convection =
      0.5 * inverse_volume * (U(i + S::i, j + S::j, k + S::k) * (u_here + u_high) - U(i, j, k) * (u_low + u_here));
  const double diffusion = viscosity * m.template inverse_width<a>(l) *
                           ((u_high - u_here) * m.template inverse_distance<a>(l + 1) -
                            (u_here - u_low) * m.template inverse_distance<a>(l));
  return diffusion - convection;
}

template <int a, class Metric>
void interpolate_axis(const Metric m, const IndexBox& owned, View<const double> U_old, View<const double> du,
                      View<double> U)
{
  using S = Step<a>;
  for_each_cell(owned.faces(a), [=] LUFF_KERNEL(int i, int j, int k) {
    U(i, j, k) = U_old(i, j, k) + 0.5 * m.template area<a>(i, j, k) * (du(i - S::i, j - S::j, k - S::k) + du(i, j, k));
  });
}

template <int a, class Metric>
void subtract_gradient_axis(const Metric m, const IndexBox& owned, View<const double> p, double dt, View<double> U)
{
  using S = Step<a>;
  for_each_cell(owned.faces(a), [=] LUFF_KERNEL(int i, int j, int k) {
    const double slope =
        (p(i, j, k) - p(i - S::i, j - S::j, k - S::k)) * m.template inverse_distance<a>(along<a>(i, j, k));
    U(i, j, k) -= dt * m.template area<a>(i, j, k) * slope;
  });
}

}  // namespace

void advance_momentum(const grid::Grid& grid, const View3<const double>& u, const View3<const double>& U,
                      double viscosity, const Vec3& force, const StageWeights& weights, const View3<double>& rate,
                      const View3<double>& increment)
{
  grid.visit([&](const auto m) {
    for (int c = 0; c < 3; ++c) {
      const auto u_c = u[c];
      const auto N = rate[c];
      const auto du = increment[c];
      const auto Ux = U[0];
      const auto Uy = U[1];
      const auto Uz = U[2];
      const double f = force[c];
      const auto w = weights;
      for_each_cell(grid.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
        const double inverse_volume =
            m.template inverse_width<0>(i) * m.template inverse_width<1>(j) * m.template inverse_width<2>(k);
        const double N_new = axis_rate<0>(m, u_c, Ux, viscosity, inverse_volume, i, j, k) +
                             axis_rate<1>(m, u_c, Uy, viscosity, inverse_volume, i, j, k) +
                             axis_rate<2>(m, u_c, Uz, viscosity, inverse_volume, i, j, k) + f;
        du(i, j, k) += w.new_rate * N_new + w.old_rate * N(i, j, k);
        N(i, j, k) = N_new;
      });
    }
  });
}

void interpolate_to_faces(const grid::Grid& grid, const View3<const double>& U_old,
                          const View3<const double>& increment, const View3<double>& U)
{
  grid.visit([&](const auto m) {
    interpolate_axis<0>(m, grid.owned(), U_old[0], increment[0], U[0]);
    interpolate_axis<1>(m, grid.owned(), U_old[1], increment[1], U[1]);
    interpolate_axis<2>(m, grid.owned(), U_old[2], increment[2], U[2]);
  });
}

void subtract_pressure_gradient(const grid::Grid& grid, const View<const double>& p, double k, const View3<double>& U)
{
  grid.visit([&](const auto m) {
    subtract_gradient_axis<0>(m, grid.owned(), p, k, U[0]);
    subtract_gradient_axis<1>(m, grid.owned(), p, k, U[1]);
    subtract_gradient_axis<2>(m, grid.owned(), p, k, U[2]);
  });
}

void recover_velocity(const grid::Grid& grid, const View3<const double>& U, const View3<double>& u)
{
  grid.visit([&](const auto m) {
    const auto Ux = U[0];
    const auto Uy = U[1];
    const auto Uz = U[2];
    const auto ux = u[0];
    const auto uy = u[1];
    const auto uz = u[2];
    for_each_cell(grid.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
      const double a = 0.5 * m.template inverse_width<0>(i);
      const double b = m.template inverse_width<1>(j);
      const double c = m.template inverse_width<2>(k);
      ux(i, j, k) = 0.5 * b * c * (Ux(i, j, k) + Ux(i + 1, j, k));
      uy(i, j, k) = a * c * (Uy(i, j, k) + Uy(i, j + 1, k));
      uz(i, j, k) = a * b * (Uz(i, j, k) + Uz(i, j, k + 1));
    });
  });
}

double convective_rate(const grid::Grid& grid, const View3<const double>& U)
{
  return grid.ranks().max(grid.visit([&](const auto m) {
    const auto Ux = U[0];
    const auto Uy = U[1];
    const auto Uz = U[2];
    return max_cells(grid.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
      const auto larger = [](double a, double b) { return a > b ? a : b; };
      const double inverse_volume =
          m.template inverse_width<0>(i) * m.template inverse_width<1>(j) * m.template inverse_width<2>(k);
      return inverse_volume * (larger(std::abs(Ux(i, j, k)), std::abs(Ux(i + 1, j, k))) +
                               larger(std::abs(Uy(i, j, k)), std::abs(Uy(i, j + 1, k))) +
                               larger(std::abs(Uz(i, j, k)), std::abs(Uz(i, j, k + 1))));
    });
  }));
}

double diffusive_rate(const grid::Grid& grid)
{
  double rate = 0.0;
  for (int a = 0; a < 3; ++a) {
    double finest = grid.width(a, 0);
    for (int i = 1; i < grid.cells()[a]; ++i)
      finest = std::min(finest, grid.width(a, i));
    rate += 1.0 / (finest * finest);
  }
  return rate;
}

}  // namespace luff::operators

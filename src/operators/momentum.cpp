// SPDX-License-Identifier: BSD-3-Clause
#include "operators/momentum.hpp"

#include <cmath>

#include "operators/curvilinear.hpp"

namespace luff::operators {

namespace {

template <int a>
LUFF_INLINE_KERNEL int along(int i, int j, int k)
{
  return a == 0 ? i : a == 1 ? j : k;
}

/// Convection and diffusion of one component through the two faces normal to axis a, per volume.
template <int a, class Metric>
LUFF_INLINE_KERNEL double axis_rate(const Metric& m, const View<const double>& u, const View<const double>& U,
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

/// S . v of the low face normal to a, v the mean of its two cells.
template <int a, class Metric>
LUFF_INLINE_KERNEL double flux_of_mean(const Metric& m, const View3<const double>& v, int i, int j, int k)
{
  using S = Step<a>;
  if constexpr (grid::is_curvilinear<Metric>) {
    double flux = 0.0;
    for (int c = 0; c < 3; ++c)
      flux += m.S[a][c](i, j, k) * (v[c](i - S::i, j - S::j, k - S::k) + v[c](i, j, k));
    return 0.5 * flux;
  } else {
    return 0.5 * m.template area<a>(i, j, k) * (v[a](i - S::i, j - S::j, k - S::k) + v[a](i, j, k));
  }
}

template <int a, class Metric>
void interpolate_axis(const Metric m, const IndexBox& owned, View<const double> U_old, View3<const double> du,
                      View<double> U)
{
  for_each_cell(owned.faces(a), [=] LUFF_KERNEL(int i, int j, int k) {
    U(i, j, k) = U_old(i, j, k) + flux_of_mean<a>(m, du, i, j, k);
  });
}

/// The state that one stage of the momentum equation reads and writes.
struct MomentumFields {
  View3<const double> u;
  View3<const double> U;
  View3<double> rate;
  View3<double> increment;
};

struct MomentumTerms {
  double viscosity;
  double force[3];
  StageWeights weights;
};

template <class Metric>
void advance_straight(const Metric m, const IndexBox& owned, const MomentumFields& fields, const MomentumTerms& terms)
{
  for (int c = 0; c < 3; ++c) {
    const auto u_c = fields.u[c];
    const auto N = fields.rate[c];
    const auto du = fields.increment[c];
    const auto Ux = fields.U[0];
    const auto Uy = fields.U[1];
    const auto Uz = fields.U[2];
    const double viscosity = terms.viscosity;
    const double f = terms.force[c];
    const auto w = terms.weights;
    for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) {
      const double inverse_volume =
          m.template inverse_width<0>(i) * m.template inverse_width<1>(j) * m.template inverse_width<2>(k);
      const double N_new = axis_rate<0>(m, u_c, Ux, viscosity, inverse_volume, i, j, k) +
                           axis_rate<1>(m, u_c, Uy, viscosity, inverse_volume, i, j, k) +
                           axis_rate<2>(m, u_c, Uz, viscosity, inverse_volume, i, j, k) + f;
      du(i, j, k) += w.new_rate * N_new + w.old_rate * N(i, j, k);
      N(i, j, k) = N_new;
    });
  }
}

/// sum_f U_f (u_P + u_N)/2 outwards.
template <int a>
LUFF_INLINE_KERNEL double net_convection(const View<const double>& u, const View<const double>& U, int i, int j, int k)
{
  using S = Step<a>;
  return 0.5 * (U(i + S::i, j + S::j, k + S::k) * (u(i, j, k) + u(i + S::i, j + S::j, k + S::k)) -
                U(i, j, k) * (u(i - S::i, j - S::j, k - S::k) + u(i, j, k)));
}

/// One component of the stage in one cell.
LUFF_INLINE_KERNEL void advance_component(const GradientStencil& stencil, double inverse_volume,
                                          const View<const double>& u, const View3<const double>& U,
                                          const MomentumTerms& terms, double force, const View<double>& N,
                                          const View<double>& du, int i, int j, int k)
{
  const double convection =
      net_convection<0>(u, U[0], i, j, k) + net_convection<1>(u, U[1], i, j, k) + net_convection<2>(u, U[2], i, j, k);
  const double N_new = inverse_volume * (terms.viscosity * stencil.net_outflow(u, i, j, k) - convection) + force;
  du(i, j, k) += terms.weights.new_rate * N_new + terms.weights.old_rate * N(i, j, k);
  N(i, j, k) = N_new;
}

/// The components are written out: a loop over them would keep the one over cells from being vectorised (59 instead of
/// 25 ns per cell).
void advance_curvilinear(const grid::Curvilinear m, const IndexBox& owned, const MomentumFields& fields,
                         const MomentumTerms& terms)
{
  for_each_cell(owned, [m, fields, terms] LUFF_KERNEL(int i, int j, int k) {
    GradientStencil stencil;
    stencil.load<0>(m, i, j, k);
    stencil.load<1>(m, i, j, k);
    stencil.load<2>(m, i, j, k);
    const double inverse_volume = 1.0 / m.V(i, j, k);
    advance_component(stencil, inverse_volume, fields.u[0], fields.U, terms, terms.force[0], fields.rate[0],
                      fields.increment[0], i, j, k);
    advance_component(stencil, inverse_volume, fields.u[1], fields.U, terms, terms.force[1], fields.rate[1],
                      fields.increment[1], i, j, k);
    advance_component(stencil, inverse_volume, fields.u[2], fields.U, terms, terms.force[2], fields.rate[2],
                      fields.increment[2], i, j, k);
  });
}

template <class Metric>
void recover_straight(const Metric m, const IndexBox& owned, const View3<const double>& U, const View3<double>& u)
{
  const auto Ux = U[0];
  const auto Uy = U[1];
  const auto Uz = U[2];
  const auto ux = u[0];
  const auto uy = u[1];
  const auto uz = u[2];
  for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) {
    const double a = 0.5 * m.template inverse_width<0>(i);
    const double b = m.template inverse_width<1>(j);
    const double c = m.template inverse_width<2>(k);
    ux(i, j, k) = 0.5 * b * c * (Ux(i, j, k) + Ux(i + 1, j, k));
    uy(i, j, k) = a * c * (Uy(i, j, k) + Uy(i, j + 1, k));
    uz(i, j, k) = a * b * (Uz(i, j, k) + Uz(i, j, k + 1));
  });
}

/// u = [f_1 S_2 x S_3 + f_2 S_3 x S_1 + f_3 S_1 x S_2]/(S_1 . S_2 x S_3), f_a the mean of the two fluxes.
void recover_curvilinear(const grid::Curvilinear m, const IndexBox& owned, const View3<const double>& U,
                         const View3<double>& u)
{
  for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) {
    const AreaVector S1 = centre_area<0>(m, i, j, k);
    const AreaVector S2 = centre_area<1>(m, i, j, k);
    const AreaVector S3 = centre_area<2>(m, i, j, k);
    const AreaVector S23 = cross(S2, S3);
    const AreaVector S31 = cross(S3, S1);
    const AreaVector S12 = cross(S1, S2);
    const double inverse = 1.0 / (S1.x * S23.x + S1.y * S23.y + S1.z * S23.z);
    // Sums instead of means on both sides of S_a . u = f_a.
    const double f1 = inverse * (U[0](i, j, k) + U[0](i + 1, j, k));
    const double f2 = inverse * (U[1](i, j, k) + U[1](i, j + 1, k));
    const double f3 = inverse * (U[2](i, j, k) + U[2](i, j, k + 1));
    u[0](i, j, k) = f1 * S23.x + f2 * S31.x + f3 * S12.x;
    u[1](i, j, k) = f1 * S23.y + f2 * S31.y + f3 * S12.y;
    u[2](i, j, k) = f1 * S23.z + f2 * S31.z + f3 * S12.z;
  });
}

/// sum_d 1/h_d^2 of a cell.
template <class Metric>
LUFF_INLINE_KERNEL double sum_of_inverse_squares(const Metric& m, int i, int j, int k)
{
  if constexpr (grid::is_curvilinear<Metric>) {
    return (m.G[0](i, j, k) + m.G[1](i, j, k) + m.G[2](i, j, k)) / m.V(i, j, k);
  } else {
    const double a = m.template inverse_width<0>(i);
    const double b = m.template inverse_width<1>(j);
    const double c = m.template inverse_width<2>(k);
    return a * a + b * b + c * c;
  }
}

/// 1/V of a cell.
template <class Metric>
LUFF_INLINE_KERNEL double inverse_volume(const Metric& m, int i, int j, int k)
{
  if constexpr (grid::is_curvilinear<Metric>)
    return 1.0 / m.V(i, j, k);
  else
    return m.template inverse_width<0>(i) * m.template inverse_width<1>(j) * m.template inverse_width<2>(k);
}

template <class Metric>
double largest_convective_rate(const Metric m, const IndexBox& owned, const View3<const double>& U)
{
  const auto Ux = U[0];
  const auto Uy = U[1];
  const auto Uz = U[2];
  return max_cells(owned, [=] LUFF_KERNEL(int i, int j, int k) {
    const auto larger = [](double a, double b) { return a > b ? a : b; };
    return inverse_volume(m, i, j, k) * (larger(std::abs(Ux(i, j, k)), std::abs(Ux(i + 1, j, k))) +
                                         larger(std::abs(Uy(i, j, k)), std::abs(Uy(i, j + 1, k))) +
                                         larger(std::abs(Uz(i, j, k)), std::abs(Uz(i, j, k + 1))));
  });
}

template <class Metric>
double largest_sum_of_inverse_squares(const Metric m, const IndexBox& owned)
{
  return max_cells(owned, [=] LUFF_KERNEL(int i, int j, int k) { return sum_of_inverse_squares(m, i, j, k); });
}

}  // namespace

void advance_momentum(const grid::Grid& grid, const View3<const double>& u, const View3<const double>& U,
                      double viscosity, const Vec3& force, const StageWeights& weights, const View3<double>& rate,
                      const View3<double>& increment)
{
  const MomentumFields fields{u, U, rate, increment};
  const MomentumTerms terms{viscosity, {force[0], force[1], force[2]}, weights};
  grid.visit([&](const auto m) {
    if constexpr (grid::is_curvilinear<std::remove_const_t<decltype(m)>>)
      advance_curvilinear(m, grid.owned(), fields, terms);
    else
      advance_straight(m, grid.owned(), fields, terms);
  });
}

void interpolate_to_faces(const grid::Grid& grid, const View3<const double>& U_old,
                          const View3<const double>& increment, const View3<double>& U)
{
  grid.visit([&](const auto m) {
    interpolate_axis<0>(m, grid.owned(), U_old[0], increment, U[0]);
    interpolate_axis<1>(m, grid.owned(), U_old[1], increment, U[1]);
    interpolate_axis<2>(m, grid.owned(), U_old[2], increment, U[2]);
  });
}

void recover_velocity(const grid::Grid& grid, const View3<const double>& U, const View3<double>& u)
{
  grid.visit([&](const auto m) {
    if constexpr (grid::is_curvilinear<std::remove_const_t<decltype(m)>>)
      recover_curvilinear(m, grid.owned(), U, u);
    else
      recover_straight(m, grid.owned(), U, u);
  });
}

double convective_rate(const grid::Grid& grid, const View3<const double>& U)
{
  return grid.ranks().max(grid.visit([&](const auto m) { return largest_convective_rate(m, grid.owned(), U); }));
}

double diffusive_rate(const grid::Grid& grid)
{
  return grid.ranks().max(grid.visit([&](const auto m) { return largest_sum_of_inverse_squares(m, grid.owned()); }));
}

double largest_speed(const grid::Grid& grid, const View3<const double>& u)
{
  return std::sqrt(grid.ranks().max(max_cells(grid.owned(), [u] LUFF_KERNEL(int i, int j, int k) {
    return u[0](i, j, k) * u[0](i, j, k) + u[1](i, j, k) * u[1](i, j, k) + u[2](i, j, k) * u[2](i, j, k);
  })));
}

void extrapolate(const IndexBox& owned, const View<const double>& now, const View<const double>& before, double w,
                 const View<double>& result)
{
  for_each_cell(owned, [=] LUFF_KERNEL(int i, int j, int k) {
    result(i, j, k) = (1.0 + w) * now(i, j, k) - w * before(i, j, k);
  });
}

}  // namespace luff::operators

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/flow_moments.hpp"

#include <cmath>

#include "parallel/for_each.hpp"
#include "parallel/vector_field.hpp"
#include "simulation/grid_snapshot.hpp"

namespace luff::simulation {

FlowMoments::FlowMoments(const IndexBox& owned) : u(make_field3<double>(owned)), p(owned), pp(owned)
{
  for (Field<double>& s : uu)
    s = Field<double>(owned);
}

/// m <- m + f d,  s_ab <- s_ab + dt (1 - f) d_a d_b,  d = x - m, f = dt/T.
void FlowMoments::add(const fluid::FlowSolver& flow, double dt)
{
  time += dt;
  const double share = dt / time;
  const double weight = dt * (1.0 - share);
  const View3<const double> u_old = flow.velocity_before();
  const View3<const double> u_new = views(flow.state().u);
  const View<const double> p_new = flow.state().p.view();
  const View3<double> u_mean = views(u);
  const View<double> p_mean = p.view();
  const View3<double> normal = {uu[0].view(), uu[1].view(), uu[2].view()};
  const View3<double> shear = {uu[3].view(), uu[4].view(), uu[5].view()};  // uv, vw, uw
  const View<double> square = pp.view();
  for_each_cell(p.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
    double d[3];
    for (int c = 0; c < 3; ++c) {
      d[c] = 0.5 * (u_old[c](i, j, k) + u_new[c](i, j, k)) - u_mean[c](i, j, k);
      u_mean[c](i, j, k) += share * d[c];
      normal[c](i, j, k) += weight * d[c] * d[c];
    }
    shear[0](i, j, k) += weight * d[0] * d[1];
    shear[1](i, j, k) += weight * d[1] * d[2];
    shear[2](i, j, k) += weight * d[0] * d[2];
    const double d_p = p_new(i, j, k) - p_mean(i, j, k);
    p_mean(i, j, k) += share * d_p;
    square(i, j, k) += weight * d_p * d_p;
  });
}

output::FlowSnapshot moments_snapshot(const grid::Grid& grid, const FlowMoments& moments, double density)
{
  output::FlowSnapshot snapshot = grid_snapshot(grid);
  const IndexBox& owned = grid.owned();
  const double per_time = moments.time > 0.0 ? 1.0 / moments.time : 0.0;
  const auto covariance = [&](int pair, const Index3& c) { return per_time * moments.uu[pair].view()(c); };
  snapshot.fields.push_back(
      cell_field("velocity_mean", 3, owned, [&](const Index3& c) -> Vec3 { return at(views(moments.u), c); }));
  snapshot.fields.push_back(cell_field("velocity_rms", 3, owned, [&](const Index3& c) -> Vec3 {
    return {std::sqrt(covariance(0, c)), std::sqrt(covariance(1, c)), std::sqrt(covariance(2, c))};
  }));
  snapshot.fields.push_back(cell_field("velocity_covariance", 6, owned, [&](const Index3& c) {
    Eigen::Matrix<double, 6, 1> all;
    for (int pair = 0; pair < 6; ++pair)
      all[pair] = covariance(pair, c);
    return all;
  }));
  snapshot.fields.push_back(
      cell_field("pressure_mean", 1, owned, [&](const Index3& c) -> double { return density * moments.p.view()(c); }));
  snapshot.fields.push_back(cell_field("pressure_rms", 1, owned, [&](const Index3& c) -> double {
    return density * std::sqrt(per_time * moments.pp.view()(c));
  }));
  return snapshot;
}

}  // namespace luff::simulation

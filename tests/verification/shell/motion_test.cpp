// SPDX-License-Identifier: BSD-3-Clause
// Motion in time by each scheme: momentum, frequency, order in time, energy, moving supports.
#include <cmath>

#include <gtest/gtest.h>

#include "shell/dynamics.hpp"
#include "support/free_flight.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

Eigen::VectorXd no_fluid(const Shell& shell)
{
  return Eigen::VectorXd::Zero(3 * shell.n_vertices());
}

/// `steps` steps of dt without fluid.
void advance(Dynamics& dynamics, double dt, int steps)
{
  const Eigen::VectorXd none = no_fluid(dynamics.shell());
  const double t0 = dynamics.accepted().t;
  for (int n = 1; n <= steps; ++n) {
    const double t = t0 + n * dt;
    const auto trial = dynamics.solve(t, dt, none, dynamics.predicted_positions(dt));
    dynamics.accept(trial.positions, t, dt, none);
  }
}

/// Errors after 500 steps, the energy's largest on the way.
test::FreeFlight::Errors fly(const TimeScheme& scheme, bool lumped_mass)
{
  test::FreeFlight flight(scheme, lumped_mass);
  double energy = 0;
  for (int n = 0; n < 500; ++n) {
    flight.step(2e-3);
    energy = std::max(energy, std::abs(flight.errors().energy));
  }
  const auto [last, momentum, angular_momentum] = flight.errors();
  std::printf("  after 500 steps: momentum %.1e, angular momentum %.1e, largest energy error %.1e\n", momentum,
              angular_momentum, energy);
  return {energy, momentum, angular_momentum};
}

TEST(Motion, FreeFlightKeepsMomentumAndEnergy)
{
  const auto error = fly(TimeScheme::newmark(), false);
  EXPECT_LT(error.momentum, 1e-13);
  EXPECT_LT(error.angular_momentum, 1e-4);
  EXPECT_LT(error.energy, 1e-3);
}

TEST(Motion, FreeFlightByTheMidpointRuleKeepsAngularMomentumToRoundOff)
{
  for (const bool lumped : {false, true}) {
    const auto error = fly(TimeScheme::midpoint(), lumped);
    EXPECT_LT(error.momentum, 1e-13);
    EXPECT_LT(error.angular_momentum, 1e-11);
    EXPECT_LT(error.energy, 1e-3);
  }
}

TEST(Motion, GeneralisedAlphaLosesEnergyButNoMomentum)
{
  const auto error = fly(TimeScheme::generalised_alpha(0.5), false);
  EXPECT_LT(error.momentum, 1e-13);
  EXPECT_GT(error.energy, 1e-6);
  EXPECT_LT(error.energy, 0.1);
}

struct Strip {
  Strip(double damping_mass = 0, double damping_stiffness = 0)
      : mesh(test::sheet(1, 0.2, 14, 2)),
        shell(mesh,
              {.thickness = 0.01,
               .density = 1,
               .material = SaintVenantKirchhoff{1e6, 0},
               .damping_mass = damping_mass,
               .damping_stiffness = damping_stiffness},
              {{.kind = SupportKind::Clamped,
                .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}}),
        tip(test::vertices_where(mesh, [](auto& X) { return X.x() == 1; }).front())
  {
  }

  /// Upward velocity in the shape of the first bending mode, `speed` at the tip.
  Eigen::VectorXd first_mode(double speed) const
  {
    const double b = 1.8751040687, c = 0.7340955;
    Eigen::VectorXd v = Eigen::VectorXd::Zero(3 * shell.n_vertices());
    for (int i = 0; i < shell.n_vertices(); ++i) {
      const double s = b * mesh.vertices[i].x();
      v[3 * i + 2] = speed * (std::cosh(s) - std::cos(s) - c * (std::sinh(s) - std::sin(s))) / 2;
    }
    return v;
  }

  surface::TriangleMesh mesh;
  Shell shell;
  int tip;
};

/// First angular frequency of a slender cantilever of length 1, thickness .01, E = 1e6, rho = 1.
const double euler_bernoulli = std::pow(1.8751040687, 2) * std::sqrt(1e6 * 1e-4 / 12);

TEST(Motion, CantileverSwingsAtItsFirstFrequency)
{
  const Strip strip;
  const double period = 2 * M_PI / euler_bernoulli, dt = period / 200;
  Dynamics dynamics(strip.shell, {}, {}, 0, strip.first_mode(1e-3));
  std::vector<double> crossings;  // of the tip through zero
  double last = 0;
  while (crossings.size() < 6) {
    advance(dynamics, dt, 1);
    const double now = dynamics.accepted().x[3 * strip.tip + 2];
    if (last * now < 0)
      crossings.push_back(dynamics.accepted().t - dt * now / (now - last));
    last = now;
  }
  const double omega = M_PI * 5 / (crossings[5] - crossings[0]);
  std::printf("  first frequency in time: %+.3f %%\n", 100 * (omega / euler_bernoulli - 1));
  EXPECT_LT(std::abs(omega / euler_bernoulli - 1), 0.005);
}

// A thick soft strip, so that the steps resolve its stretching waves too; it swings up by half its length.
TEST(Motion, PositionsAndVelocitiesAreSecondOrderInTime)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.3, 6, 2);
  const Shell shell(
      mesh, {.thickness = 0.1, .density = 1, .material = SaintVenantKirchhoff{1e4, 0.3}},
      {{.kind = SupportKind::Clamped, .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}});
  Eigen::VectorXd v0 = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v)
    v0[3 * v + 2] = 8 * std::pow(mesh.vertices[v].x(), 2);
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::generalised_alpha(0.8), TimeScheme::midpoint()}) {
    const auto state_after = [&](int steps) {
      Dynamics dynamics(shell, {}, {.scheme = scheme}, 0, v0);
      advance(dynamics, 0.08 / steps, steps);
      return dynamics.accepted();
    };
    const State a = state_after(1600), b = state_after(3200), c = state_after(6400);
    const double order_x = test::observed_order((a.x - b.x).norm(), (b.x - c.x).norm());
    const double order_v = test::observed_order((a.v - b.v).norm(), (b.v - c.v).norm());
    const double height = c.x.reshaped(3, mesh.n_vertices()).row(2).maxCoeff();
    std::printf("  order of positions %.3f, of velocities %.3f; tip at height %.2f\n", order_x, order_v, height);
    EXPECT_GT(height, 0.3);
    EXPECT_NEAR(order_x, 2, 0.05);
    EXPECT_NEAR(order_v, 2, 0.05);
  }
}

// The clamp moves by A (1 - cos W t). Relative to it the beam's modes phi_n, of unit mean square and with participation
// g_n = 2 sigma_n/beta_n, follow q'' + w_n^2 q = -g_n A W^2 cos(W t): q = g_n A W^2 (cos w_n t - cos W t)/(w_n^2 -
// W^2).
TEST(Motion, CantileverShakenAtItsClampFollowsItsModes)
{
  struct Mode {
    double beta, sigma, tip;
  };
  const Mode modes[] = {{1.8751040687, 0.7340955138, 2},
                        {4.6940911330, 1.0184673190, -2},
                        {7.8547574382, 0.9992244965, 2},
                        {10.9955407349, 1.0000335533, -2}};
  const double EI_per_mass = 1e6 * 1e-4 / 12, A = 1e-4, W = 2.2 * euler_bernoulli;
  const auto exact = [&](double t) {
    double w = A * (1 - std::cos(W * t));
    for (const Mode& m : modes) {
      const double w_n = m.beta * m.beta * std::sqrt(EI_per_mass);
      w += m.tip * 2 * m.sigma / m.beta * A * W * W * (std::cos(w_n * t) - std::cos(W * t)) / (w_n * w_n - W * W);
    }
    return w;
  };
  const surface::TriangleMesh mesh = test::sheet(1, 0.2, 20, 3);
  const Shell shell(mesh, {.thickness = 0.01, .density = 1, .material = SaintVenantKirchhoff{1e6, 0}},
                    {{.kind = SupportKind::Clamped,
                      .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; }),
                      .motion = Motion{.translation = [=](const Vec3&, double t) {
                        return Vec3(0, 0, A * (1 - std::cos(W * t)));
                      }}}});
  const int tip = test::vertices_where(mesh, [](auto& X) { return X.x() == 1; })[1];
  const double period = 2 * M_PI / euler_bernoulli, dt = period / 200;
  for (const TimeScheme& scheme : {TimeScheme::newmark(), TimeScheme::generalised_alpha(0.8), TimeScheme::midpoint()}) {
    Dynamics dynamics(shell, {}, {.scheme = scheme, .first_step = dt});
    double largest = 0, error = 0;
    for (int n = 1; n <= 400; ++n) {
      advance(dynamics, dt, 1);
      const double w = exact(dynamics.accepted().t);
      largest = std::max(largest, std::abs(w));
      error = std::max(error, std::abs(dynamics.accepted().x[3 * tip + 2] - w));
    }
    std::printf("  tip moves by up to %.2f of the shaking, largest error %.2f %% of that\n", largest / A,
                100 * error / largest);
    EXPECT_LT(error, 0.03 * largest);
    EXPECT_GT(largest, 2 * A);
  }
}

TEST(Motion, DampingFollowsRayleighsFormula)
{
  for (const auto& [mass, stiffness] : {std::pair{0.5, 0.0}, std::pair{0.0, 2e-4}}) {
    const Strip strip(mass, stiffness);
    const double period = 2 * M_PI / euler_bernoulli, dt = period / 200;
    Dynamics dynamics(strip.shell, {}, {}, 0, strip.first_mode(1e-3));
    const double E0 = dynamics.ledger().kinetic;
    const int steps = 600;
    advance(dynamics, dt, steps);
    const EnergyLedger& ledger = dynamics.ledger();
    const double rate = -std::log((ledger.kinetic + ledger.elastic) / E0) / (steps * dt);
    const double exact = mass + stiffness * euler_bernoulli * euler_bernoulli;
    std::printf("  energy decay %.4f against %.4f; ledger closes to %.1e\n", rate, exact,
                (ledger.kinetic + ledger.elastic + ledger.damping_work) / E0 - 1);
    EXPECT_NEAR(rate / exact, 1, 0.02);
    EXPECT_NEAR((ledger.kinetic + ledger.elastic + ledger.damping_work) / E0, 1, 1e-6);
  }
}

TEST(Motion, LedgerClosesUnderGravityAndFluidForces)
{
  const surface::TriangleMesh mesh = test::sheet(1, 0.2, 10, 2);
  const Shell shell(
      mesh, {.thickness = 0.01, .density = 100, .material = SaintVenantKirchhoff{1e6, 0.3}, .gravity = Vec3(0, 0, -2)},
      {{.kind = SupportKind::Hinged, .vertices = test::vertices_where(mesh, [](auto& X) { return X.x() == 0; })}});
  const auto closure = [&](double dt, int steps) {
    Dynamics dynamics(shell, {});
    const Eigen::VectorXd fluid = 1e-3 * test::random_vector(3 * shell.n_vertices(), 3);
    for (int n = 1; n <= steps; ++n) {
      const auto trial = dynamics.solve(n * dt, dt, fluid, dynamics.predicted_positions(dt));
      dynamics.accept(trial.positions, n * dt, dt, fluid);
    }
    const EnergyLedger& e = dynamics.ledger();
    return std::abs(e.kinetic + e.elastic - e.external_work) / e.kinetic;
  };
  const double coarse = closure(4e-3, 100), fine = closure(2e-3, 200);
  std::printf("  imbalance over kinetic energy %.1e, at half the step %.1e\n", coarse, fine);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);
}

}  // namespace
}  // namespace luff::shell

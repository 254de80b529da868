// SPDX-License-Identifier: BSD-3-Clause
// Newmark's method: momentum, frequency, order in time, energy.
#include <cmath>

#include <gtest/gtest.h>

#include "shell/dynamics.hpp"
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

Vec3 sum(const Eigen::VectorXd& nodal)
{
  return nodal.reshaped(3, nodal.size() / 3).rowwise().sum();
}

Vec3 angular_momentum(const Shell& shell, const State& state)
{
  const Eigen::VectorXd p = shell.mass_times(state.v);
  Vec3 L = Vec3::Zero();
  for (int v = 0; v < shell.n_vertices(); ++v)
    L += Vec3(state.x.segment<3>(3 * v)).cross(Vec3(p.segment<3>(3 * v)));
  return L;
}

// Translation, spin, bending and twist of large amplitude, nothing held, no damping.
TEST(Motion, FreeFlightKeepsMomentumAndEnergy)
{
  const Shell shell(test::sheet(1, 0.7, 6, 4),
                    {.thickness = 0.02, .density = 1, .material = SaintVenantKirchhoff{1e5, 0.3}}, {});
  Eigen::VectorXd v0(3 * shell.n_vertices());
  for (int v = 0; v < shell.n_vertices(); ++v) {
    const Vec3 r = shell.reference().vertices[v] - Vec3(0.5, 0.35, 0);
    v0.segment<3>(3 * v) =
        Vec3(0.3, 0.1, 0.2) + Vec3(1, 0.5, 2).cross(r) + Vec3(0, 0, 4 * (r.x() * r.x() - 1.0 / 12) + 4 * r.x() * r.y());
  }
  Dynamics dynamics(shell, {}, {}, 0, v0);
  const Vec3 P = sum(shell.mass_times(dynamics.accepted().v)), L = angular_momentum(shell, dynamics.accepted());
  const double E = dynamics.ledger().kinetic + dynamics.ledger().elastic;
  double energy_error = 0;
  for (int n = 0; n < 500; ++n) {
    advance(dynamics, 2e-3, 1);
    energy_error = std::max(energy_error, std::abs((dynamics.ledger().kinetic + dynamics.ledger().elastic) / E - 1));
  }
  const double dP = (sum(shell.mass_times(dynamics.accepted().v)) - P).norm() / P.norm();
  const double dL = (angular_momentum(shell, dynamics.accepted()) - L).norm() / L.norm();
  std::printf("  after 500 steps: momentum %.1e, angular momentum %.1e, largest energy error %.1e\n", dP, dL,
              energy_error);
  EXPECT_LT(dP, 1e-10);
  EXPECT_LT(dL, 1e-4);
  EXPECT_LT(energy_error, 1e-3);
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
  const auto state_after = [&](int steps) {
    Dynamics dynamics(shell, {}, {}, 0, v0);
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

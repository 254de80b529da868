// SPDX-License-Identifier: BSD-3-Clause
// A free sheet that translates, spins, bends and twists with large amplitude, without dissipation.
#pragma once

#include <vector>

#include "shell/dynamics.hpp"
#include "support/shells.hpp"

namespace luff::test {

/// Of a vector of three numbers per vertex.
inline Vec3 sum(const Eigen::VectorXd& nodal)
{
  return nodal.reshaped(3, nodal.size() / 3).rowwise().sum();
}

inline Vec3 angular_momentum(const shell::Shell& shell, const shell::State& state)
{
  const Eigen::VectorXd p = shell.mass_times(state.v);
  Vec3 L = Vec3::Zero();
  for (int v = 0; v < shell.n_vertices(); ++v)
    L += Vec3(state.x.segment<3>(3 * v)).cross(Vec3(p.segment<3>(3 * v)));
  return L;
}

class FreeFlight {
 public:
  /// Relative changes since the start.
  struct Errors {
    double energy;
    double momentum;
    double angular_momentum;
  };

  explicit FreeFlight(const shell::TimeScheme& scheme, bool lumped_mass)
      : shell_(sheet(1, 0.7, 6, 4),
               {.thickness = 0.02,
                .density = 1,
                .material = shell::SaintVenantKirchhoff{1e5, 0.3},
                .lumped_mass = lumped_mass},
               {}),
        // Angular momentum is kept as far as forces balance.
        dynamics_(shell_, {}, {.scheme = scheme, .newton = {.tolerance = 1e-13}}, 0, initial_velocity(shell_)),
        energy_(dynamics_.ledger().kinetic + dynamics_.ledger().elastic),
        momentum_(sum(shell_.mass_times(dynamics_.accepted().v))),
        angular_momentum_(test::angular_momentum(shell_, dynamics_.accepted()))
  {
  }

  void step(double dt)
  {
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * shell_.n_vertices());
    const double t = dynamics_.accepted().t + dt;
    const auto trial = dynamics_.solve(t, dt, none, dynamics_.predicted_positions(dt));
    iterations_ += trial.report.iterations;
    dynamics_.accept(trial.positions, t, dt, none);
  }

  Errors errors() const
  {
    const Vec3 P = sum(shell_.mass_times(dynamics_.accepted().v));
    const Vec3 L = test::angular_momentum(shell_, dynamics_.accepted());
    return {(dynamics_.ledger().kinetic + dynamics_.ledger().elastic) / energy_ - 1,
            (P - momentum_).norm() / momentum_.norm(), (L - angular_momentum_).norm() / angular_momentum_.norm()};
  }
  const shell::Dynamics& dynamics() const { return dynamics_; }
  long iterations() const { return iterations_; }

 private:
  static Eigen::VectorXd initial_velocity(const shell::Shell& shell)
  {
    Eigen::VectorXd v0(3 * shell.n_vertices());
    for (int v = 0; v < shell.n_vertices(); ++v) {
      const Vec3 r = shell.reference().vertices[v] - Vec3(0.5, 0.35, 0);
      v0.segment<3>(3 * v) = Vec3(0.3, 0.1, 0.2) + Vec3(1, 0.5, 2).cross(r) +
                             Vec3(0, 0, 4 * (r.x() * r.x() - 1.0 / 12) + 4 * r.x() * r.y());
    }
    return v0;
  }

  shell::Shell shell_;
  shell::Dynamics dynamics_;
  double energy_;
  Vec3 momentum_;
  Vec3 angular_momentum_;
  long iterations_ = 0;
};

}  // namespace luff::test

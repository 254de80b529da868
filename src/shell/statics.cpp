// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of a shell under slowly growing loads.
#include "shell/statics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/error.hpp"

namespace luff::shell {

namespace {

/// The three translations and three small rotations about the centre, columns of unit length.
Eigen::Matrix<double, Eigen::Dynamic, 6> rigid_motions(const Shell& shell)
{
  const auto& X = shell.reference().vertices;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : X)
    centre += x / static_cast<double>(X.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> R(3 * X.size(), 6);
  for (std::size_t v = 0; v < X.size(); ++v)
    for (int d = 0; d < 3; ++d) {
      R.block<3, 1>(3 * v, d) = Vec3::Unit(d);
      R.block<3, 1>(3 * v, 3 + d) = Vec3::Unit(d).cross(X[v] - centre);
    }
  R.colwise().normalize();
  return R;
}

/// Follows the equilibrium as the load factor grows.
class LoadPath {
 public:
  LoadPath(const Shell& shell, const Loads& loads, const StaticOptions& options)
      : shell_(shell), options_(options), loads_(loads.at(options.time)), tangent_(shell, options.linear_solver)
  {
  }

  /// Move x from the equilibrium at load factor `from` to that at `to`; in two halves where that fails.
  NewtonReport advance(Eigen::VectorXd& x, double from, double to, const std::string& when, int halvings_left)
  {
    const Eigen::VectorXd start = x;
    try {
      return equilibrate(x, to, when);
    } catch (const RunError&) {
      if (halvings_left == 0)
        throw;
    }
    x = start;
    const double middle = 0.5 * (from + to);
    advance(x, from, middle, when, halvings_left - 1);
    return advance(x, middle, to, when, halvings_left - 1);
  }

 private:
  NewtonReport equilibrate(Eigen::VectorXd& x, double factor, const std::string& when)
  {
    const Equilibrium equilibrium{
        .residual = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
          return factor * loads_.force(y) - shell_.internal_force(y);
        },
        .tangent =
            [&](const Eigen::VectorXd& y, BlockMatrix& K) {
              shell_.add_tangent(y, K);
              loads_.subtract_stiffness(y, factor, K);
            },
    };
    tangent_.valid = false;
    return newton(shell_, equilibrium, options_.newton, tangent_, x, when);
  }

  const Shell& shell_;
  const StaticOptions& options_;
  LoadsAtTime loads_;
  KeptTangent tangent_;
};

}  // namespace

/// A rigid motion meets no resistance when neither a held displacement nor a kept slope opposes it.
void check_supported(const Shell& shell)
{
  BlockMatrix K(shell.pattern());
  shell.add_tangent(shell.reference_positions(), K);
  double largest = 0;
  for (const double k : K.values())
    largest = std::max(largest, std::abs(k));
  const auto R = rigid_motions(shell);
  Eigen::Matrix<double, 6, 6> resistance;
  for (int j = 0; j < 6; ++j) {
    Eigen::VectorXd opposed = K * Eigen::VectorXd(R.col(j)) / largest;
    for (std::size_t i = 0; i < shell.held().size(); ++i)
      opposed[static_cast<Eigen::Index>(i)] += shell.held()[i] * R(static_cast<Eigen::Index>(i), j);
    resistance.col(j) = R.transpose() * opposed;
  }
  // Round-off of the products; the slope kept by a clamp of thickness h opposes with about (h/element)^2 / 100.
  constexpr double none = 1e-14;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(0.5 * (resistance + resistance.transpose()));
  if (modes.eigenvalues()[0] < none)
    fail_input(
        "shell '{}' can move as a rigid body, so it has no static equilibrium; add a support (a hinged edge alone "
        "lets it turn) or analyse its motion in time",
        shell.name());
}

StaticStep solve_static(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options,
                        const std::function<void(const StaticStep&)>& on_step)
{
  if (options.steps < 1)
    fail_input("shell '{}': static analysis with steps = {} must have at least 1", shell.name(), options.steps);
  check_supported(shell);
  LoadPath path(shell, Loads(shell, loads), options);
  StaticStep now;
  now.positions = shell.reference_positions();
  for (int step = 1; step <= options.steps; ++step) {
    const double from = now.load_factor;
    now.step = step;
    now.load_factor = static_cast<double>(step) / options.steps;
    const std::string when =
        fmt::format("static step {} of {}, load factor {:.6g}", step, options.steps, now.load_factor);
    now.report = path.advance(now.positions, from, now.load_factor, when, options.max_halvings);
    now.folds = check_folds(shell, now.positions, options.fold_limit, when);
    if (on_step)
      on_step(now);
  }
  return now;
}

}  // namespace luff::shell

// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium of a shell under slowly growing loads.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "shell/contact/contact_step.hpp"
#include "shell/folds.hpp"
#include "shell/loads.hpp"
#include "shell/newton.hpp"

namespace luff::shell {

/// What happens where the load grows beyond what the shell can carry in balance.
enum class Stabilisation {
  None,    ///< the analysis fails and says that it met a limit point
  Damping  ///< damped continuation to the next stable equilibrium, settle()
};

/// What the next step of a path depends on besides the equilibrium that it starts from.
struct StepControl {
  double length = 0;        ///< of the step: in the load factor, a part of the controlled displacement, or [L] of arc
  int successes = 0;        ///< in a row at this length
  double first_length = 0;  ///< of an arc-length path [L]
  Eigen::VectorXd last_move = {};  ///< displacement of an arc-length path's last step, empty before
};

/// An equilibrium from which a path can go on with the same bits.
struct PathPoint {
  int step = 0;
  double load_factor = 0;
  Eigen::VectorXd positions;
  StepControl control;
};

struct StaticOptions {
  int steps = 20;          ///< equal steps whose ends are reported, at least 1
  int max_halvings = 6;    ///< of a step that finds no equilibrium; shortened steps grow again
  double time = 0;         ///< at which loads and motions that depend on time are evaluated
  double fold_limit = 75;  ///< a step that folds the shell by more over an edge is refused [degrees]
  NewtonPolicy newton{.tolerance = 1e-11, .slow = 0, .max_iterations = 20};
  LinearSolverKind linear_solver = LinearSolverKind::Direct;
  Stabilisation stabilisation = Stabilisation::None;  ///< of solve_static alone; Damping needs the direct solver
  /// Of solve_static alone. Every step then goes down the potential energy to a stable equilibrium, through snaps if
  /// need be. Bodies are where `body_positions` of the load factor says.
  std::optional<ContactOptions> contact{};
  /// The path goes on from here, a step of the same analysis; absent: from the reference.
  std::optional<PathPoint> from{};
};

/// What touches at an equilibrium.
struct StaticContact {
  ContactReport report;
  double energy = 0;  ///< of the barriers [M L^2/T^2]
  int crossings = 0;  ///< edges that pass through triangles
};

/// Equilibrium at one load factor.
struct StaticStep {
  int step = 0;
  double load_factor = 0;  ///< step/steps, multiplies every load, gravity and the supports' motion
  Eigen::VectorXd positions;
  StepControl control = {};   ///< of the next step
  NewtonReport report;        ///< of the last Newton solve
  int iterations = 0;         ///< of Newton's method since the last reported step, failed attempts included
  int damped_iterations = 0;  ///< of settle() since the last reported step; more than zero: the shell snapped
  Folds folds;
  std::optional<StaticContact> contact;
};

/// Whether the step from start to end left the path for another equilibrium: whether it is much longer than the path's
/// tangent at its end (increment of x for the step's increment of the load). On a smooth path the ratio of the two
/// tends to one as steps shrink, across a snap it grows without bound. Steps within the `round_off` [L] don't jump.
bool has_jumped(const Eigen::VectorXd& start, const Eigen::VectorXd& end, const Eigen::VectorXd& tangent,
                double round_off);

/// Where the path can go on from.
PathPoint point_of(const StaticStep& step);
/// The step's number, load factor and positions are those of the point.
void set_equilibrium(const PathPoint& point, StaticStep& step);

using OnStaticStep = std::function<void(const StaticStep&)>;

/// \throws InputError when a rigid motion of the shell meets no support.
void check_supported(const Shell& shell);

/// What every static analysis asks for. \throws InputError as solve_static does.
void check_static(const Shell& shell, const StaticOptions& options);

/// \throws InputError naming the `analysis` when a support moves, whose motion its load factor cannot follow.
void check_supports_rest(const Shell& shell, std::string_view analysis);

/// Load stepping with full Newton steps, halved where they fail; returns the last equilibrium, reports each.
/// \throws InputError when a rigid motion of the shell meets no support, for steps < 1, damping without the direct
/// solver or with contact, and as Contact does. \throws RunError naming the step, load factor and place when there is
/// no equilibrium (at a limit point it says so) or the shell folds.
StaticStep solve_static(const Shell& shell, const std::vector<Load>& loads, const StaticOptions& options = {},
                        const OnStaticStep& on_step = {});

}  // namespace luff::shell

// SPDX-License-Identifier: BSD-3-Clause
// How the next guess of a fixed point d = S(F(d)) follows from the last guess and its image.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace luff::coupling {

/// What an acceleration remembers from one step to the next, as plain numbers; what a method does not know is empty.
struct History {
  double factor = 0;                  ///< Aitken's
  std::vector<std::int64_t> columns;  ///< differences of each past step, newest first
  std::vector<double> lengths;        ///< of all of them, one after the other; see quasi_newton.hpp
  std::vector<double> residuals;      ///< each as long as the interface vector
  std::vector<double> images;
};

/// One interface vector at a time: it never learns what flows or bends on either side.
///
/// A step is begin_step(), next() after every iteration that did not converge, end_step().
/// All vectors of a step have the same length; d is the guess, d_tilde = S(F(d)) its image.
class Acceleration {
 public:
  virtual ~Acceleration() = default;
  virtual void begin_step() = 0;
  /// The next guess; the same units as d.
  virtual Eigen::VectorXd next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde) = 0;
  virtual void end_step(bool converged) = 0;
  /// Between two steps.
  [[nodiscard]] virtual History history() const { return {}; }
  /// Go on from the history of the same method; of another one nothing is taken over.
  virtual void restore(const History& /*history*/) {}
};

enum class AccelerationMethod { Constant, Aitken, QuasiNewton };

/// All numbers are without dimension.
struct AccelerationOptions {
  AccelerationMethod method = AccelerationMethod::QuasiNewton;
  double relaxation =
      0.5;  ///< w of constant relaxation, and of a first iteration that knows nothing better; 0 < w <= 1
  double largest_factor = 1.0;  ///< Aitken: bound of |w|; > 0
  int reused_steps = 2;         ///< quasi-Newton: accepted steps whose differences are kept; >= 0
  double filter = 1e-2;  ///< quasi-Newton: a difference is dropped below this share of new direction; 0 < filter < 1
};

/// Throws InputError if an option is out of its range.
std::unique_ptr<Acceleration> make_acceleration(const AccelerationOptions& options);

}  // namespace luff::coupling

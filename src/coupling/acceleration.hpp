// SPDX-License-Identifier: BSD-3-Clause
// How the next guess of a fixed point d = S(F(d)) follows from the last guess and its image.
#pragma once

#include <memory>

#include <Eigen/Core>

namespace luff::coupling {

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

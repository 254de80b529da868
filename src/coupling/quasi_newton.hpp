// SPDX-License-Identifier: BSD-3-Clause
// Interface quasi-Newton with an inverse Jacobian from a least-squares model, IQN-ILS (degroote_2009_performance).
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "coupling/acceleration.hpp"

namespace luff::coupling {

/// A change of the residual r = d~ - d and the change of the image d~ that came with it,
/// both divided by the length of the former, so that steps of any size weigh the same.
struct Difference {
  double length = 0;  ///< of the former before the division
  Eigen::VectorXd residual;
  Eigen::VectorXd image;
};

/// How far a difference of a past step may be stretched to meet a residual.
///
/// The last differences of a step are as small as its tolerance; stretched too far, the round-off in them grows with
/// them. Measured over fifty steps of a flag on one, two and four ranks: without a bound the forces drifted apart by
/// 1e-5, with 100 by 2e-6, with 70 by 3e-10, with 50 by 4e-11; a mass ratio of 0.01 takes 10.7, 11.4, 11.6 and 11.8
/// iterations.
inline constexpr double largest_stretch = 70;

/// d_{k+1} = d~_k + W a  with  a = argmin |V a + r_k|,  V and W the differences of r and d~, newest first,
/// by this step's iterations and then by those of the last `reused_steps` accepted steps.
///
/// Least squares by QR; a column that adds less than `filter` of itself to those before it is dropped.
/// When the residual grows twice in a row the columns of past steps are forgotten; a step that fails forgets all.
class QuasiNewton : public Acceleration {
 public:
  QuasiNewton(double first_relaxation, int reused_steps, double filter);
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde) override;
  void end_step(bool converged) override;
  [[nodiscard]] History history() const override;
  void restore(const History& history) override;

  /// Columns that the last update used, after the filter.
  int columns_used() const { return columns_used_; }
  /// Accepted steps whose columns are still kept.
  int steps_kept() const { return static_cast<int>(past_.size()); }

 private:
  struct Iterate {
    Eigen::VectorXd residual;
    Eigen::VectorXd image;
  };

  void learn(const Iterate& now);
  void watch_growth(double residual_norm);
  std::vector<const Difference*> newest_first(double residual_norm) const;

  double first_relaxation_;
  int reused_steps_;
  double filter_;
  std::optional<Iterate> last_;
  std::deque<Difference> current_;           // newest first
  std::deque<std::deque<Difference>> past_;  // newest step first
  int growths_in_a_row_ = 0;
  int columns_used_ = 0;
};

}  // namespace luff::coupling

// SPDX-License-Identifier: BSD-3-Clause
// IQN-ILS: least squares over filtered differences.
#include "coupling/quasi_newton.hpp"

#include <Eigen/Dense>

namespace luff::coupling {

namespace {

/// V = Q R over the columns that passed the filter, columns of V taken in the order given.
struct FilteredQr {
  std::vector<Eigen::VectorXd> Q;
  std::vector<Eigen::VectorXd> R;  // column i holds R(0..i, i)
  std::vector<const Difference*> kept;
};

/// v - Q Q^T v by Gram-Schmidt, twice, so that what is left is orthogonal to round-off; returns Q^T v.
Eigen::VectorXd orthogonalise(const std::vector<Eigen::VectorXd>& Q, Eigen::VectorXd& v)
{
  Eigen::VectorXd share = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(Q.size()));
  for (int pass = 0; pass < 2; ++pass)
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      const double s = Q[i].dot(v);
      share[i] += s;
      v -= s * Q[i];
    }
  return share;
}

FilteredQr filtered_qr(const std::vector<const Difference*>& columns, double filter)
{
  FilteredQr qr;
  for (const Difference* column : columns) {
    if (static_cast<Eigen::Index>(qr.kept.size()) == column->residual.size())
      break;
    Eigen::VectorXd rest = column->residual;
    Eigen::VectorXd r = orthogonalise(qr.Q, rest);
    const double new_share = rest.norm();
    if (!(new_share > filter * column->residual.norm()))
      continue;
    r.conservativeResize(r.size() + 1);
    r[r.size() - 1] = new_share;
    qr.Q.push_back(rest / new_share);
    qr.R.push_back(std::move(r));
    qr.kept.push_back(column);
  }
  return qr;
}

/// a = -R^-1 Q^T r
Eigen::VectorXd least_squares(const FilteredQr& qr, const Eigen::VectorXd& residual)
{
  const auto n = static_cast<Eigen::Index>(qr.kept.size());
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd a(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    R.col(i).head(i + 1) = qr.R[i];
    a[i] = -qr.Q[i].dot(residual);
  }
  R.triangularView<Eigen::Upper>().solveInPlace(a);
  return a;
}

}  // namespace

QuasiNewton::QuasiNewton(double first_relaxation, int reused_steps, double filter)
    : first_relaxation_(first_relaxation), reused_steps_(reused_steps), filter_(filter)
{
}

void QuasiNewton::begin_step()
{
  last_.reset();
  current_.clear();
  growths_in_a_row_ = 0;
}

Eigen::VectorXd QuasiNewton::next(const Eigen::VectorXd& d, const Eigen::VectorXd& d_tilde)
{
  Iterate now{d_tilde - d, d_tilde};
  if (last_)
    learn(now);
  const FilteredQr qr = filtered_qr(newest_first(now.residual.norm()), filter_);
  columns_used_ = static_cast<int>(qr.kept.size());

  Eigen::VectorXd guess = d_tilde;
  if (qr.kept.empty()) {
    guess = d + first_relaxation_ * now.residual;
  } else {
    const Eigen::VectorXd a = least_squares(qr, now.residual);
    for (Eigen::Index i = 0; i < a.size(); ++i)
      guess += a[i] * qr.kept[i]->image;
  }
  last_ = std::move(now);
  return guess;
}

void QuasiNewton::end_step(bool converged)
{
  if (!converged) {
    past_.clear();
    return;
  }
  if (!current_.empty())
    past_.push_front(std::move(current_));
  current_.clear();
  while (static_cast<int>(past_.size()) > reused_steps_)
    past_.pop_back();
}

History QuasiNewton::history() const
{
  History history;
  for (const auto& step : past_) {
    history.columns.push_back(static_cast<std::int64_t>(step.size()));
    for (const Difference& change : step) {
      history.lengths.push_back(change.length);
      history.residuals.insert(history.residuals.end(), change.residual.begin(), change.residual.end());
      history.images.insert(history.images.end(), change.image.begin(), change.image.end());
    }
  }
  return history;
}

void QuasiNewton::restore(const History& history)
{
  past_.clear();
  const auto n =
      history.lengths.empty() ? 0 : static_cast<Eigen::Index>(history.residuals.size() / history.lengths.size());
  std::size_t at = 0;
  for (const std::int64_t columns : history.columns) {
    std::deque<Difference>& step = past_.emplace_back();
    for (std::int64_t c = 0; c < columns; ++c, ++at)
      step.push_back({history.lengths[at], Eigen::Map<const Eigen::VectorXd>(history.residuals.data() + n * at, n),
                      Eigen::Map<const Eigen::VectorXd>(history.images.data() + n * at, n)});
  }
}

void QuasiNewton::learn(const Iterate& now)
{
  watch_growth(now.residual.norm());
  Difference change{0, now.residual - last_->residual, now.image - last_->image};
  change.length = change.residual.norm();
  if (change.length == 0)
    return;
  change.residual /= change.length;
  change.image /= change.length;
  current_.push_front(std::move(change));
}

void QuasiNewton::watch_growth(double residual_norm)
{
  growths_in_a_row_ = residual_norm > last_->residual.norm() ? growths_in_a_row_ + 1 : 0;
  if (growths_in_a_row_ >= 2)
    past_.clear();
}

std::vector<const Difference*> QuasiNewton::newest_first(double residual_norm) const
{
  std::vector<const Difference*> columns;
  for (const Difference& change : current_)
    columns.push_back(&change);
  for (const auto& step : past_)
    for (const Difference& change : step)
      if (largest_stretch * change.length >= residual_norm)
        columns.push_back(&change);
  return columns;
}

}  // namespace luff::coupling

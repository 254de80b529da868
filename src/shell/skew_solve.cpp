// SPDX-License-Identifier: BSD-3-Clause
// Linear systems whose matrix is a factorised symmetric one less a skew one.
#include "shell/skew_solve.hpp"

#include <Eigen/QR>

namespace luff::shell {

namespace {

/// Takes the parts along the first n columns of V out of w, twice; returns them.
Eigen::VectorXd orthogonalise(const Eigen::MatrixXd& V, int n, Eigen::VectorXd& w)
{
  Eigen::VectorXd parts = Eigen::VectorXd::Zero(n);
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::VectorXd more = V.leftCols(n).transpose() * w;
    w -= V.leftCols(n) * more;
    parts += more;
  }
  return parts;
}

}  // namespace

Eigen::VectorXd solve_with_skew(LinearSolver& solver, const SkewProduct& skew, const Eigen::VectorXd& r)
{
  constexpr int most = 50;
  constexpr double tolerance = 1e-10;
  const Eigen::VectorXd b = solver.solve(r);
  const double size = b.norm();
  if (!(size > 0))
    return b;
  Eigen::MatrixXd V(b.size(), most + 1), H = Eigen::MatrixXd::Zero(most + 1, most);
  V.col(0) = b / size;
  Eigen::VectorXd y;
  int n = 0;
  for (double left = 1; n < most && left > tolerance; ++n) {
    Eigen::VectorXd w = V.col(n) - solver.solve(skew(V.col(n)));
    H.col(n).head(n + 1) = orthogonalise(V, n + 1, w);
    H(n + 1, n) = w.norm();
    const Eigen::MatrixXd small = H.topLeftCorner(n + 2, n + 1);
    const Eigen::VectorXd start = size * Eigen::VectorXd::Unit(n + 2, 0);
    y = small.householderQr().solve(start);
    left = (small * y - start).norm() / size;
    V.col(n + 1) = left > tolerance ? Eigen::VectorXd(w / H(n + 1, n)) : w;
  }
  return V.leftCols(n) * y;
}

}  // namespace luff::shell

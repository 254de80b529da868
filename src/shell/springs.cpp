// SPDX-License-Identifier: BSD-3-Clause
// Elastic supports.
#include "shell/springs.hpp"

namespace luff::shell {

void Springs::append(const Springs& other, int first_vertex)
{
  for (const auto& [vertex, stiffness] : other.on_vertices)
    on_vertices.push_back({vertex + first_vertex, stiffness});
  for (OnEdge spring : other.on_edges) {
    spring.turn.renumber(first_vertex);
    on_edges.push_back(spring);
  }
}

double Springs::energy(const Eigen::VectorXd& X, const Eigen::VectorXd& x) const
{
  double sum = 0;
  for (const auto& [v, k] : on_vertices) {
    const Vec3 u = x.segment<3>(3 * v) - X.segment<3>(3 * v);
    sum += 0.5 * u.dot(k.cwiseProduct(u));
  }
  for (const auto& [turn, k] : on_edges)
    sum += 0.5 * k * turn.angle(x) * turn.angle(x);
  return sum;
}

void Springs::add_force(const Eigen::VectorXd& X, const Eigen::VectorXd& x, Eigen::VectorXd& f) const
{
  for (const auto& [v, k] : on_vertices)
    f.segment<3>(3 * v) += k.cwiseProduct(x.segment<3>(3 * v) - X.segment<3>(3 * v));
  for (const auto& [turn, k] : on_edges) {
    const Mat3 moments = k * turn.angle(x) * turn.gradient(x);
    for (int i = 0; i < 3; ++i)
      f.segment<3>(3 * turn.corner()[i]) += moments.col(i);
  }
}

void Springs::add_stiffness(const Eigen::VectorXd& x, BlockMatrix& K) const
{
  const BlockPattern& pattern = K.pattern();
  for (const auto& [v, k] : on_vertices)
    K.block(pattern.slot(v, v)).diagonal() += k;
  for (const auto& [turn, k] : on_edges) {
    const Mat3 gradient = turn.gradient(x), curvature = turn.angle(x) * turn.curvature(x);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        K.block(pattern.slot(turn.corner()[i], turn.corner()[j])) +=
            k * (gradient.col(i) * gradient.col(j).transpose() + turn.weight(i, j) * curvature);
  }
}

}  // namespace luff::shell

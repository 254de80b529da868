// SPDX-License-Identifier: BSD-3-Clause
// Prescribed loads on a shell.
#include "shell/loads.hpp"

#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "shell/edges.hpp"

namespace luff::shell {

namespace {

Mat3 cross_matrix(const Vec3& d)
{
  Mat3 W;
  W << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
  return W;
}

}  // namespace

Load renumbered(Load load, int first_vertex, int first_triangle)
{
  const auto shift = [](std::vector<int>& numbers, int by) {
    for (int& number : numbers)
      number += by;
  };
  std::visit(
      [&](auto& kind) {
        if constexpr (requires { kind.vertices; })
          shift(kind.vertices, first_vertex);
        else
          shift(kind.triangles, first_triangle);
      },
      load);
  return load;
}

Loads::Loads(const Shell& shell, std::vector<Load> loads) : shell_(shell), loads_(std::move(loads))
{
  for (Load& load : loads_) {
    shares_.emplace_back();
    if (const auto* force = std::get_if<PointForce>(&load)) {
      check_vertices(force->vertices, "force");
      shares_.back() = shares(shell_.reference(), shell_.topology(), force->vertices);
    } else if (auto* traction = std::get_if<Traction>(&load)) {
      check_triangles(traction->triangles);
    } else if (auto* pressure = std::get_if<Pressure>(&load)) {
      check_triangles(pressure->triangles);
    } else if (const auto* edge_force = std::get_if<EdgeForce>(&load)) {
      check_edges(edge_force->vertices, "edge force");
    } else {
      check_edges(std::get<EdgeMoment>(load).vertices, "edge moment");
    }
  }
  Eigen::VectorXd gravity(3 * shell_.n_vertices());
  for (const PieceRange& piece : shell_.pieces())
    gravity.segment(3 * piece.first_vertex, 3 * piece.n_vertices) =
        piece.properties.gravity.replicate(piece.n_vertices, 1);
  weight_ = shell_.mass_times(gravity);
}

void Loads::check_vertices(const std::vector<int>& vertices, std::string_view kind) const
{
  if (vertices.empty())
    fail_input("shell '{}': a {} selects no vertex; widen its 'where'", shell_.name(), kind);
  for (const int v : vertices)
    if (v < 0 || v >= shell_.n_vertices())
      fail_input("shell '{}': a {} acts on vertex {}, not in 0..{}", shell_.name(), kind, v, shell_.n_vertices() - 1);
}

void Loads::check_edges(const std::vector<int>& vertices, std::string_view kind) const
{
  check_vertices(vertices, kind);
  if (boundary_edges(shell_.reference(), shell_.topology(), vertices).empty())
    fail_input("shell '{}': an {} selects no boundary edge; widen its 'where' to both ends of one", shell_.name(),
               kind);
}

void Loads::check_triangles(std::vector<int>& triangles) const
{
  const int n = shell_.reference().n_triangles();
  if (triangles.empty()) {
    triangles.resize(n);
    std::iota(triangles.begin(), triangles.end(), 0);
  }
  for (const int t : triangles)
    if (t < 0 || t >= n)
      fail_input("shell '{}': a load acts on triangle {}, not in 0..{}", shell_.name(), t, n - 1);
}

LoadsAtTime Loads::at(double t) const
{
  LoadsAtTime now;
  now.dead_ = weight_;
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    if (const auto* point = std::get_if<PointForce>(&loads_[l]))
      add(*point, shares_[l], t, now);
    else if (const auto* traction = std::get_if<Traction>(&loads_[l]))
      add(*traction, t, now);
    else if (const auto* pressure = std::get_if<Pressure>(&loads_[l]))
      add(*pressure, t, now);
    else if (const auto* edge_force = std::get_if<EdgeForce>(&loads_[l]))
      add(*edge_force, t, now);
    else
      add(std::get<EdgeMoment>(loads_[l]), t, now);
  }
  return now;
}

void Loads::add(const PointForce& load, const std::vector<double>& shares, double t, LoadsAtTime& now) const
{
  for (std::size_t i = 0; i < load.vertices.size(); ++i) {
    const int v = load.vertices[i];
    now.dead_.segment<3>(3 * v) += shares[i] * load.force(shell_.reference().vertices[v], t);
  }
}

void Loads::add(const Traction& load, double t, LoadsAtTime& now) const
{
  const auto& mesh = shell_.reference();
  for (const int e : load.triangles) {
    const Vec3 third = shell_.elements()[e].area / 3 * load.traction(surface::centroid(mesh, e), t);
    for (const int v : mesh.triangles[e])
      now.dead_.segment<3>(3 * v) += third;
  }
}

void Loads::add(const Pressure& load, double t, LoadsAtTime& now) const
{
  const auto& mesh = shell_.reference();
  for (const int e : load.triangles)
    now.pressed_.push_back({mesh.triangles[e], load.pressure(surface::centroid(mesh, e), t)});
}

/// f_a = l/6 (2 q_a + q_b) at the ends a, b of each edge
void Loads::add(const EdgeForce& load, double t, LoadsAtTime& now) const
{
  const auto& mesh = shell_.reference();
  for (const surface::TriangleEdge side : boundary_edges(mesh, shell_.topology(), load.vertices)) {
    const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
    const Vec3 &A = mesh.vertices[a], &B = mesh.vertices[b];
    const double sixth = (B - A).norm() / 6;
    const Vec3 at_a = load.force(A, t), at_b = load.force(B, t);
    now.dead_.segment<3>(3 * a) += sixth * (2 * at_a + at_b);
    now.dead_.segment<3>(3 * b) += sixth * (2 * at_b + at_a);
  }
}

void Loads::add(const EdgeMoment& load, double t, LoadsAtTime& now) const
{
  const auto& mesh = shell_.reference();
  for (const surface::TriangleEdge side : boundary_edges(mesh, shell_.topology(), load.vertices)) {
    const auto [a, b] = surface::edge_vertices(mesh.triangles[side.triangle], side.edge);
    const EdgeTurn turn(mesh, side);
    now.turned_.push_back({turn, turn.length() * load.moment(0.5 * (mesh.vertices[a] + mesh.vertices[b]), t)});
  }
}

/// f_i = p/6 (x2 - x1) x (x3 - x1) at every corner for a pressure, f_i = M l d theta/d x_i for an edge's
/// moment, on top of the dead forces.
Eigen::VectorXd LoadsAtTime::force(const Eigen::VectorXd& x) const
{
  Eigen::VectorXd f = dead_;
  for (const Pressed& triangle : pressed_) {
    const auto [a, b, c] = triangle.corner;
    const Vec3 twice_area =
        (x.segment<3>(3 * b) - x.segment<3>(3 * a)).cross(x.segment<3>(3 * c) - x.segment<3>(3 * a));
    for (const int v : triangle.corner)
      f.segment<3>(3 * v) += triangle.pressure / 6 * twice_area;
  }
  for (const auto& [turn, moment] : turned_) {
    const Mat3 gradient = turn.gradient(x);
    for (int i = 0; i < 3; ++i)
      f.segment<3>(3 * turn.corner()[i]) += moment * gradient.col(i);
  }
  return f;
}

/// Pressure: d f_i / d x_j = p/6 [d_j]x for every corner i, d_j the edge opposite corner j; half of it and of its
/// transpose. Moment: all of it.
void LoadsAtTime::subtract_stiffness(const Eigen::VectorXd& x, double factor, BlockMatrix& K) const
{
  for (const auto& [corner, pressure] : pressed_) {
    std::array<Mat3, 3> derivative;
    for (int j = 0; j < 3; ++j)
      derivative[j] = factor * pressure / 6 *
                      cross_matrix(x.segment<3>(3 * corner[(j + 2) % 3]) - x.segment<3>(3 * corner[(j + 1) % 3]));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        K.block(K.pattern().slot(corner[i], corner[j])) -= 0.5 * (derivative[j] + derivative[i].transpose());
  }
  for (const auto& [turn, moment] : turned_) {
    const Mat3 curvature = turn.curvature(x);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        K.block(K.pattern().slot(turn.corner()[i], turn.corner()[j])) -=
            factor * moment * turn.weight(i, j) * curvature;
  }
}

/// With d f_i / d x_j = p/6 [d_j]x for every i, half of it less half of its transpose: p/12 (sum_j d_j x v_j + d_k x
/// sum_j v_j) at corner k.
Eigen::VectorXd LoadsAtTime::skew_stiffness_times(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
  for (const auto& [corner, pressure] : pressed_) {
    std::array<Vec3, 3> opposite;
    Vec3 turned = Vec3::Zero(), sum = Vec3::Zero();
    for (int j = 0; j < 3; ++j) {
      opposite[j] = x.segment<3>(3 * corner[(j + 2) % 3]) - x.segment<3>(3 * corner[(j + 1) % 3]);
      const Vec3 v_j = v.segment<3>(3 * corner[j]);
      turned += opposite[j].cross(v_j);
      sum += v_j;
    }
    for (int k = 0; k < 3; ++k)
      result.segment<3>(3 * corner[k]) += pressure / 12 * (turned + opposite[k].cross(sum));
  }
  return result;
}

}  // namespace luff::shell

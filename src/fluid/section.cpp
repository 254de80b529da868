// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/section.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include "core/error.hpp"

namespace luff::fluid {

namespace {

using Complex = std::complex<double>;

std::array<int, 2> other_axes(int axis)
{
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

/// All nodes of a side, the lower of the two other axes fastest; each comes from the rank that holds the cell above it.
std::vector<Vec3> gather_nodes(const grid::Grid& grid, int axis, int end)
{
  const auto [a, b] = other_axes(axis);
  const Index3& cells = grid.cells();
  const IndexBox& owned = grid.owned();
  const int row = cells[a] + 1;
  std::vector<double> places(static_cast<std::size_t>(3) * row * (cells[b] + 1), 0.0);
  const int layer = end == 0 ? 0 : cells[axis];
  const bool mine = end == 0 ? owned.lo[axis] == 0 : owned.hi[axis] == cells[axis];
  const auto last = [&](int d) { return owned.hi[d] == cells[d] ? cells[d] + 1 : owned.hi[d]; };
  for (int q = owned.lo[b]; mine && q < last(b); ++q)
    for (int p = owned.lo[a]; p < last(a); ++p) {
      Index3 node{};
      node[axis] = layer;
      node[a] = p;
      node[b] = q;
      const Vec3 x = grid.node(node[0], node[1], node[2]);
      std::copy_n(x.data(), 3, &places[static_cast<std::size_t>(3) * (p + row * q)]);
    }
  MPI_Allreduce(MPI_IN_PLACE, places.data(), static_cast<int>(places.size()), MPI_DOUBLE, MPI_SUM, grid.ranks().comm());
  std::vector<Vec3> nodes(places.size() / 3);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    nodes[n] = Vec3(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
  return nodes;
}

}  // namespace

Section::Section(const grid::Grid& grid, int axis, int end, const std::array<std::array<bool, 2>, 2>& no_slip)
    : no_slip_(no_slip)
{
  const auto axes = other_axes(axis);
  for (int a = 0; a < 2; ++a) {
    n_[a] = grid.cells()[axes[a]];
    periodic_[a] = grid.ranks().periodic(axes[a]);
  }
  const std::vector<Vec3> nodes = gather_nodes(grid, axis, end);
  const int row = n_[0] + 1;
  for (int q = 0; q < n_[1]; ++q)
    for (int p = 0; p < n_[0]; ++p) {
      const Vec3& x00 = nodes[p + row * q];
      const Vec3& x10 = nodes[p + 1 + row * q];
      const Vec3& x01 = nodes[p + row * (q + 1)];
      const Vec3& x11 = nodes[p + 1 + row * (q + 1)];
      area_.push_back(0.5 * (x11 - x00).cross(x01 - x10).norm());
      const Vec3 T_1 = 0.5 * (x10 - x00 + x11 - x01);
      const Vec3 T_2 = 0.5 * (x01 - x00 + x11 - x10);
      centre_.push_back(0.25 * (x00 + x10 + x01 + x11));
      corners_.push_back({x00, x10, x01, x11});
      const double J = T_1.cross(T_2).norm();
      metric_.push_back({T_2.squaredNorm() / J, T_1.squaredNorm() / J, -T_1.dot(T_2) / J});
    }
}

bool Section::has_wall() const
{
  for (int a = 0; a < 2; ++a)
    if (!periodic_[a] && (no_slip_[a][0] || no_slip_[a][1]))
      return true;
  return false;
}

/// The face next to another across an edge; -1 beyond the rim.
int Section::beside(const std::array<int, 2>& face, int a, int end) const
{
  std::array<int, 2> f = face;
  f[a] += end == 0 ? -1 : 1;
  if (periodic_[a])
    f[a] = (f[a] + n_[a]) % n_[a];
  return f[a] < 0 || f[a] >= n_[a] ? -1 : number(f);
}

Section::Difference Section::difference(const std::array<int, 2>& face, int a, int end) const
{
  const double sign = end == 0 ? 1.0 : -1.0;
  const int here = number(face);
  const int next = beside(face, a, end);
  if (next >= 0)
    return {{here, next}, {sign, -sign}, 2};
  if (no_slip_[a][end])
    return {{here, here}, {2.0 * sign, 0.0}, 1, true};  // the wall is half a face away
  return {};
}

/// Shear on the edge along a wall per w, L/(T.n) D_s w with D_s x = T: its length L, its normal n in the section, and
/// the derivative of second order along the line of centres.
WallDerivative Section::wall_shear(const std::array<int, 2>& face, int a, int end) const
{
  const int here = number(face);
  const std::array<Vec3, 4>& x = corners_[here];
  const int first = end == 0 ? 0 : 1 << a;
  const Vec3& from = x[first];
  const Vec3& to = x[first + (1 << (1 - a))];
  const Vec3 on_wall = 0.5 * (from + to);
  const Vec3 near = centre_[here] - on_wall;
  const int next = beside(face, a, 1 - end);
  const Vec3 far = next < 0 ? near : Vec3(centre_[next] - on_wall);
  WallDerivative d =
      next < 0 ? WallDerivative::at(near.norm()) : WallDerivative::at(near.norm(), near.norm() + (far - near).norm());
  const Vec3 T = d.near * near + d.far * far;
  const Vec3 edge = to - from;
  const double L = edge.norm();
  const double across = (T - T.dot(edge) / (L * L) * edge).norm();
  d.near *= L / across;
  d.far *= L / across;
  return d;
}

/// The matrix is the second derivative of the energy
///
///   sum over edges of 1/2 a_e d_e^2  +  sum over faces of the mean over their four corners of G_12 d_1 d_2,
///
/// but for the shear at walls, which is of second order as the flow has it (BoundaryConditions::add_wall_stress); with
/// a_e the harmonic mean of G_aa on both sides.  At a corner whose edge carries no shear, d_1 takes the value that
/// makes the corner's energy least: -1/2 G_12^2/G_11 d_2^2 instead of the product (the closure of the flow's pressure).
std::vector<Complex> Section::developed_flow(Complex lambda) const
{
  const int size = n_[0] * n_[1];
  std::vector<Eigen::Triplet<Complex>> entries;
  const auto add = [&](const Difference& d, const Difference& e, double factor) {
    for (int m = 0; m < d.count; ++m)
      for (int n = 0; n < e.count; ++n)
        entries.emplace_back(d.face[m], e.face[n], factor * d.weight[m] * e.weight[n]);
  };
  const auto add_wall = [&](const std::array<int, 2>& face, int a, int end) {
    const WallDerivative d = wall_shear(face, a, end);
    entries.emplace_back(number(face), number(face), d.near);
    if (const int next = beside(face, a, 1 - end); next >= 0)
      entries.emplace_back(number(face), next, d.far);
  };
  for (int q = 0; q < n_[1]; ++q)
    for (int p = 0; p < n_[0]; ++p) {
      const std::array<int, 2> face{p, q};
      const int here = number(face);
      const Tensor& G = metric_[here];
      std::array<std::array<Difference, 2>, 2> d;
      for (int a = 0; a < 2; ++a)
        for (int end = 0; end < 2; ++end) {
          d[a][end] = difference(face, a, end);
          const int next = beside(face, a, end);
          // An edge between two faces is met from both: half of it each time.
          const double edge = next < 0 ? G[a] : grid::in_series(G[a], metric_[next][a]);
          if (d[a][end].at_wall)
            add_wall(face, a, end);
          else
            add(d[a][end], d[a][end], 0.5 * edge);
        }
      for (const Difference& d_1 : d[0])
        for (const Difference& d_2 : d[1]) {
          if (!d_1.at_wall)
            add(d_1, d_2, 0.25 * G[2]);
          if (!d_2.at_wall)
            add(d_2, d_1, 0.25 * G[2]);
          if (d_1.count == 0)
            add(d_2, d_2, -0.25 * G[2] * G[2] / G[0]);
          if (d_2.count == 0)
            add(d_1, d_1, -0.25 * G[2] * G[2] / G[1]);
        }
      entries.emplace_back(here, here, lambda * area_[here]);
    }
  Eigen::SparseMatrix<Complex> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<Complex>> factors(matrix);
  ensure(factors.info() == Eigen::Success, "the developed flow of a section has a regular matrix");
  const Eigen::Map<const Eigen::VectorXd> area(area_.data(), size);
  const Eigen::VectorXcd w = factors.solve(area.cast<Complex>());
  const Complex through = area.cast<Complex>().cwiseProduct(w).sum();
  std::vector<Complex> flow(size);
  for (int n = 0; n < size; ++n)
    flow[n] = w[n] / through;
  return flow;
}

}  // namespace luff::fluid

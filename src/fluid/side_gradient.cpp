// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/side_gradient.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

#include "parallel/vector_field.hpp"

namespace luff::fluid {

SideGradient::SideGradient(const grid::Grid& grid, int axis, int end, const IndexBox& cells)
    : grid_(&grid), axis_(axis), end_(end), along_{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}, cells_(cells)
{
  faces_.reserve(cells.volume());
  for_each_cell_in_order(cells, [&](int i, int j, int k) { faces_.push_back(make_face({i, j, k})); });
}

const SideGradient::Face& SideGradient::face(const Index3& c) const
{
  return faces_[cells_.position(c)];
}

/// Central where the domain goes on both ways; zero where it has one cell only.
SideGradient::Difference SideGradient::difference(int axis, const Index3& c) const
{
  const int n = grid_->cells()[axis];
  const bool goes_on = grid_->ranks().periodic(axis);
  const bool below = goes_on || c[axis] > 0;
  const bool above = goes_on || c[axis] + 1 < n;
  if (below && above)
    return {-1, {-0.5, 0.0, 0.5}, {1.0, -2.0, 1.0}};
  if (!below && !above)
    return {};
  const IndexBox& owned = grid_->owned();
  const int third = c[axis] + (above ? 2 : -2);
  const bool three = third >= 0 && third < n && third >= owned.lo[axis] - 1 && third <= owned.hi[axis];
  if (!three)
    return above ? Difference{0, {-1.0, 1.0, 0.0}, {}} : Difference{-2, {0.0, -1.0, 1.0}, {}};
  return above ? Difference{0, {-1.5, 2.0, -0.5}, {1.0, -2.0, 1.0}}
               : Difference{-2, {0.5, -2.0, 1.5}, {1.0, -2.0, 1.0}};
}

SideGradient::Face SideGradient::make_face(const Index3& c) const
{
  const auto face_centre = [&](const Index3& cell) {
    const auto [i, j, k] = stepped(cell, axis_, end_);
    return grid_->face_centre(axis_, i, j, k);
  };
  const Vec3 on_face = face_centre(c);
  const Vec3 near = grid_->centre(c);
  const double s_1 = (near - on_face).norm();
  Face face;
  Mat3 tangents;
  if (grid_->cells()[axis_] > 1) {
    const Vec3 far = grid_->centre(inwards(c, 1));
    face.normal = WallDerivative::at(s_1, s_1 + (far - near).norm());
    face.beyond = s_1 / (far - near).norm();
    tangents.col(0) = face.normal.near * (near - on_face) + face.normal.far * (far - on_face);
  } else {
    face.normal = WallDerivative::at(s_1);
    tangents.col(0) = face.normal.near * (near - on_face);
  }
  for (int m = 0; m < 2; ++m) {
    const int axis = along_[m];
    const Difference d = face.along[m] = difference(axis, c);
    if (d.alone()) {  // its direction is needed all the same
      const auto [i, j, k] = stepped(c, axis, 1);
      tangents.col(1 + m) = grid_->face_centre(axis, i, j, k) - grid_->face_centre(axis, c[0], c[1], c[2]);
      continue;
    }
    tangents.col(1 + m).setZero();
    for (int n = 0; n < 3; ++n)
      if (d.weight[n] != 0.0)
        tangents.col(1 + m) += d.weight[n] * face_centre(stepped(c, axis, d.from + n));
  }
  face.reciprocal = tangents.inverse();
  const auto [i, j, k] = stepped(c, axis_, end_);
  face.outward = (end_ == 0 ? -1.0 : 1.0) * grid_->area_vector(axis_, i, j, k);
  face.through = face.reciprocal * face.outward;
  prepare_recovery(c, face);
  return face;
}

/// Whether this block has the fluxes of the two faces next to the side.
bool SideGradient::has_second_cell() const
{
  return grid_->owned().extent(axis_) > 1;
}

/// The cell whose low face is that of the side, or one further in.
Index3 SideGradient::low_face(const Index3& c, int by) const
{
  return inwards(stepped(c, axis_, end_), by);
}

void SideGradient::prepare_recovery(const Index3& c, Face& face) const
{
  const auto area = [&](int axis, const Index3& cell) { return grid_->area_vector(axis, cell[0], cell[1], cell[2]); };
  const std::array<int, 3> axes{axis_, along_[0], along_[1]};
  Mat3 S_c;
  for (int m = 0; m < 3; ++m) {
    const Vec3 low = area(axes[m], c);
    const Vec3 high = area(axes[m], stepped(c, axes[m], 1));
    S_c.row(m) = 0.5 * (low + high).transpose();
    if (m > 0) {
      face.area[m - 1] = 0.5 * (low + high);
      face.widening[m - 1] = high - low;
    }
  }
  face.recovery = 0.125 * S_c.inverse();
  if (has_second_cell())
    face.bend = area(axis_, low_face(c, 0)) - 2.0 * area(axis_, low_face(c, 1)) + area(axis_, low_face(c, 2));
}

/// delta; along the side U_b = S_b . u_b, so that r_b = S_b . d_b^2 u_b + 2 (d_b S_b) . d_b u_b.
Vec3 SideGradient::recovery_defect(const View3<const double>& U, const Prescribed& u_b, const Index3& c,
                                   const std::array<Differences, 2>& along) const
{
  const Face& f = face(c);
  Vec3 r = Vec3::Zero();
  if (has_second_cell())
    r[0] = U[axis_](low_face(c, 0)) - 2.0 * U[axis_](low_face(c, 1)) + U[axis_](low_face(c, 2)) - f.bend.dot(u_b(c));
  for (int m = 0; m < 2; ++m)
    r[1 + m] = f.area[m].dot(along[m].second) + 2.0 * f.widening[m].dot(along[m].first);
  return f.recovery * r;
}

/// u_b, the mean of a cell beside the side and of the halo that mirrors it.
SideGradient::Prescribed SideGradient::prescribed(const View3<const double>& u) const
{
  IndexBox box = cells_;
  for (const int b : along_) {
    --box.lo[b];
    ++box.hi[b];
  }
  Prescribed u_b(box);
  for_each_cell_in_order(box, [&](int i, int j, int k) {
    const Index3 c{i, j, k};
    u_b(c) = 0.5 * (luff::at(u, c) + luff::at(u, inwards(c, -1)));
  });
  return u_b;
}

std::array<SideGradient::Differences, 2> SideGradient::along_side(const Prescribed& u_b, const Index3& c) const
{
  std::array<Differences, 2> all;
  for (int m = 0; m < 2; ++m) {
    const Difference& d = face(c).along[m];
    all[m] = {Vec3::Zero(), Vec3::Zero()};
    if (d.alone())
      continue;
    for (int n = 0; n < 3; ++n) {
      if (d.weight[n] == 0.0 && d.second[n] == 0.0)
        continue;
      const Vec3& value = u_b(stepped(c, along_[m], d.from + n));
      all[m].first += d.weight[n] * value;
      all[m].second += d.second[n] * value;
    }
  }
  return all;
}

/// D_s u.
Vec3 SideGradient::derivative_inwards(const View3<const double>& u, const View3<const double>& U, const Prescribed& u_b,
                                      const Index3& c, const std::array<Differences, 2>& along) const
{
  const WallDerivative& normal = face(c).normal;
  const Vec3 on_side = u_b(c) + recovery_defect(U, u_b, c, along);
  Vec3 derivative = normal.near * (luff::at(u, c) - on_side);
  if (normal.far != 0.0)
    derivative += normal.far * (luff::at(u, inwards(c, 1)) - on_side);
  return derivative;
}

Mat3 SideGradient::at(const View3<const double>& u, const View3<const double>& U, const Prescribed& u_b,
                      const Index3& c) const
{
  const std::array<Differences, 2> along = along_side(u_b, c);
  Mat3 D;
  D << derivative_inwards(u, U, u_b, c, along), along[0].first, along[1].first;
  return D * face(c).reciprocal;
}

double SideGradient::extrapolated(const View<const double>& p, const Index3& c) const
{
  const double beyond = face(c).beyond;
  return beyond == 0.0 ? p(c) : p(c) + beyond * (p(c) - p(inwards(c, 1)));
}

Vec3 SideGradient::missing_flux(const View3<const double>& u, const View3<const double>& U, const Prescribed& u_b,
                                const Index3& c) const
{
  const std::array<Differences, 2> along = along_side(u_b, c);
  const Vec3& through = face(c).through;
  return through[0] * derivative_inwards(u, U, u_b, c, along) + through[1] * along[0].first +
         through[2] * along[1].first - mirrored_flux(u, u_b, c);
}

/// A (u_N - u_P)/d; on curvilinear grids G_aa (u_N - u_P) + sum_b G_ab <d_b>, positive along increasing index, with the
/// tensor of P, which the halo repeats.
Vec3 SideGradient::mirrored_flux(const View3<const double>& u, const Prescribed& u_b, const Index3& c) const
{
  const Vec3 beyond = luff::at(u, inwards(c, -1)) - luff::at(u, c);
  return grid_->visit([&](const auto& m) -> Vec3 {
    if constexpr (grid::is_curvilinear<std::remove_cvref_t<decltype(m)>>) {
      Vec3 flux = m.G[axis_](c) * beyond;
      const double outwards = end_ == 0 ? -1.0 : 1.0;
      for (const int b : along_) {
        const double G = m.G[grid::symmetric(std::min(axis_, b), std::max(axis_, b))](c);
        flux += 0.5 * outwards * G * (u_b(stepped(c, b, 1)) - u_b(stepped(c, b, -1)));
      }
      return flux;
    } else {
      return face(c).outward.norm() / grid_->distance(axis_, c[axis_] + end_) * beyond;
    }
  });
}

}  // namespace luff::fluid

// SPDX-License-Identifier: BSD-3-Clause
// The force on whatever stands in a box of cells, from the momentum of the flow through the box.
#pragma once

#include "fluid/gradient_flux.hpp"
#include "parallel/vector_field.hpp"
#include "support/flow.hpp"

namespace luff::test {

/// Balance of momentum of the accepted flow in a box of cells around the sheets,
///
///   F = -rho { d/dt int u dV + sum_faces [ U u_f + p_f A e - nu A (u_out - u_in)/d ] },
///
/// independent of how the solver finds loads.  One rank.  Faces on sides of the domain are left out: symmetry planes.
class ControlVolume {
 public:
  ControlVolume(const TestFlow& flow, const IndexBox& box) : flow_(flow), box_(box) {}
  /// The box of the cells whose centres lie within `reach` of `centre` along x and y.
  ControlVolume(const TestFlow& flow, const Vec3& centre, double reach)
      : ControlVolume(flow, cells_around(flow.grid, centre, reach))
  {
  }

  /// Call after each accepted step.
  void record(double dt)
  {
    momentum_ = {momentum_[1], momentum_[2], momentum()};
    dt_ = dt;
    ++recorded_;
  }

  /// Force on the sheets at the time of the last record; three records of equal steps at least.
  [[nodiscard]] Vec3 force() const
  {
    const Vec3 growth = (1.5 * momentum_[2] - 2.0 * momentum_[1] + 0.5 * momentum_[0]) / dt_;
    return -flow_.solver.options().density * (growth + outflow());
  }

 private:
  static IndexBox cells_around(const grid::Grid& grid, const Vec3& centre, double reach)
  {
    IndexBox box = grid.owned();
    for (int axis = 0; axis < 2; ++axis) {
      while (grid.centre(axis, box.lo[axis]) < centre[axis] - reach)
        ++box.lo[axis];
      while (grid.centre(axis, box.hi[axis] - 1) > centre[axis] + reach)
        --box.hi[axis];
    }
    return box;
  }

  [[nodiscard]] Vec3 momentum() const
  {
    Vec3 sum = Vec3::Zero();
    const auto u = views(flow_.solver.state().u);
    for_each_cell_in_order(box_, [&](int i, int j, int k) {
      sum += flow_.grid.volume(i, j, k) * luff::at(u, Index3{i, j, k});
    });
    return sum;
  }

  [[nodiscard]] Vec3 outflow() const
  {
    Vec3 sum = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) {
        IndexBox faces = box_;
        faces.lo[axis] = end == 0 ? box_.lo[axis] : box_.hi[axis];
        faces.hi[axis] = faces.lo[axis] + 1;
        if (faces.lo[axis] == 0 || faces.lo[axis] == flow_.grid.cells()[axis])
          continue;
        for_each_cell_in_order(faces, [&](int i, int j, int k) {
          sum += (end == 0 ? -1.0 : 1.0) * through_face(axis, {i, j, k});
        });
      }
    return sum;
  }

  /// Momentum through the low face of a cell, along the axis, pressure and viscous stress included.
  [[nodiscard]] Vec3 through_face(int axis, const Index3& cell) const
  {
    const grid::Grid& grid = flow_.grid;
    const fluid::FlowState& state = flow_.solver.state();
    const auto u = views(state.u);
    const Index3 below = stepped(cell, axis, -1);
    const bool curvilinear = grid.kind() == grid::Kind::Curvilinear;
    // Of the cell above, where the face is.
    const double w = curvilinear ? 0.5 : 0.5 * grid.width(axis, below[axis]) / grid.distance(axis, cell[axis]);
    const auto p = [&](const Index3& c) { return 1.5 * state.p.view()(c) - 0.5 * state.p_before.view()(c); };
    const Vec3 gradient = fluid::gradient_flux(grid, u, axis, cell);
    return 0.5 * views(state.U)[axis](cell) * (luff::at(u, cell) + luff::at(u, below)) -
           flow_.solver.options().viscosity * gradient +
           (w * p(cell) + (1.0 - w) * p(below)) * grid.area_vector(axis, cell[0], cell[1], cell[2]);
  }

  const TestFlow& flow_;
  IndexBox box_;
  std::array<Vec3, 3> momentum_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double dt_ = 0.0;
  int recorded_ = 0;
};

}  // namespace luff::test

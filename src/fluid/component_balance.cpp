// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/component_balance.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace luff::fluid {

void ComponentBalance::update(const immersed::CutLinks& links, const poisson::PressureSolver& pressure)
{
  pressure_ = &pressure;
  const int components = pressure.components();
  unknown_.assign(components, -1);
  sealed_.clear();
  gates_.clear();
  leak_ = 0.0;
  if (components == 1)
    return;
  for (int c = 0; c < components; ++c)
    if (pressure.is_floating(c)) {
      unknown_[c] = static_cast<int>(sealed_.size());
      sealed_.push_back(c);
    }
  if (sealed_.empty())
    return;
  label_beside(links, pressure);
  find_gates(links);
  factorise();
}

void ComponentBalance::label_beside(const immersed::CutLinks& links, const poisson::PressureSolver& pressure)
{
  for (const immersed::CutFace& face : links.faces())
    for (const Index3& c : {face.cell, stepped(face.cell, face.axis, -1)})
      if (grid_.owned().contains(c))
        label_.view()(c) = pressure.component_of(c);
  halo_.exchange({label_.view()});
}

void ComponentBalance::find_gates(const immersed::CutLinks& links)
{
  for (const immersed::CutFace& face : links.faces()) {
    const int below = label_.view()(stepped(face.cell, face.axis, -1));
    const int above = label_.view()(face.cell);
    if (below != above)
      gates_.push_back({face.axis, face.cell, below, above, grid_.owned().contains(face.cell)});
  }
}

/// The graph of components, each gate an edge of weight A.
void ComponentBalance::factorise()
{
  const auto n = static_cast<Eigen::Index>(sealed_.size());
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (const Gate& gate : gates_) {
    if (!gate.owned)
      continue;
    const double A = grid_.area(gate.axis, gate.cell[0], gate.cell[1], gate.cell[2]);
    const int below = unknown_[gate.below];
    const int above = unknown_[gate.above];
    if (below >= 0)
      laplacian(below, below) += A;
    if (above >= 0)
      laplacian(above, above) += A;
    if (below >= 0 && above >= 0) {
      laplacian(below, above) -= A;
      laplacian(above, below) -= A;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, laplacian.data(), static_cast<int>(n * n), MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  laplacian_.compute(laplacian);
}

std::vector<ComponentBalance::Outflow> ComponentBalance::outflow_of_sides(const View3<double>& U) const
{
  std::vector<Outflow> outflow(sealed_.size());
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      if (!grid_.ranks().at_boundary(axis, end))
        continue;
      IndexBox cells = grid_.owned();
      (end == 0 ? cells.hi : cells.lo)[axis] = end == 0 ? cells.lo[axis] + 1 : cells.hi[axis] - 1;
      for_each_cell_in_order(cells, [&](int i, int j, int k) {
        const double flux = (end == 0 ? -1.0 : 1.0) * U[axis](stepped({i, j, k}, axis, end));
        const int sealed = flux == 0.0 ? -1 : unknown_[pressure_->component_of({i, j, k})];
        if (sealed < 0)
          return;
        outflow[sealed].net += flux;
        outflow[sealed].gross += std::abs(flux);
        const Vec3 x = grid_.centre(i, j, k);
        for (int d = 0; d < 3; ++d)
          outflow[sealed].moment[d] += std::abs(flux) * x[d];
      });
    }
  constexpr int numbers = sizeof(Outflow) / sizeof(double);
  MPI_Allreduce(MPI_IN_PLACE, outflow.data(), static_cast<int>(numbers * outflow.size()), MPI_DOUBLE, MPI_SUM,
                grid_.ranks().comm());
  return outflow;
}

/// Sampling a profile leaves less than a hundredth of the flow, as in BoundaryConditions.
void ComponentBalance::refuse_inflow(const std::vector<Outflow>& outflow, const TimeStep& step) const
{
  for (const Outflow& of : outflow)
    if (std::abs(of.net) > 0.01 * of.gross)
      fail_run(
          "step {}, t = {:.6g}: the sides of the grid bring a net volume flux of {:.3g} around ({:.4g}, {:.4g}, "
          "{:.4g}) "
          "into a part of the fluid that sheets or bodies seal off from every outlet: let the inflow stop before they "
          "close, or give that part an outflow side",
          step.index, step.t_new, -of.net, of.moment[0] / of.gross, of.moment[1] / of.gross, of.moment[2] / of.gross);
}

/// Of each sealed component, through gates and sides.
Eigen::VectorXd ComponentBalance::net_outflow(const View3<double>& U, const TimeStep& step) const
{
  Eigen::VectorXd net = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sealed_.size()));
  for (const Gate& gate : gates_) {
    if (!gate.owned)
      continue;
    const double flux = U[gate.axis](gate.cell);
    if (unknown_[gate.below] >= 0)
      net[unknown_[gate.below]] += flux;
    if (unknown_[gate.above] >= 0)
      net[unknown_[gate.above]] -= flux;
  }
  MPI_Allreduce(MPI_IN_PLACE, net.data(), static_cast<int>(net.size()), MPI_DOUBLE, MPI_SUM, grid_.ranks().comm());
  const std::vector<Outflow> sides = outflow_of_sides(U);
  refuse_inflow(sides, step);
  for (Eigen::Index n = 0; n < net.size(); ++n)
    net[n] += sides[n].net;
  return net;
}

void ComponentBalance::apply(const View3<double>& U, const TimeStep& step)
{
  if (sealed_.empty())
    return;
  const Eigen::VectorXd lambda = laplacian_.solve(-net_outflow(U, step));
  const auto of = [&](int component) { return unknown_[component] < 0 ? 0.0 : lambda[unknown_[component]]; };
  double leak = 0.0;
  for (const Gate& gate : gates_) {
    const double through = of(gate.below) - of(gate.above);
    const auto [i, j, k] = gate.cell;
    U[gate.axis](i, j, k) += grid_.area(gate.axis, i, j, k) * through;
    leak = std::max(leak, std::abs(through));
  }
  leak_ = grid_.ranks().max(leak);
}

}  // namespace luff::fluid

// SPDX-License-Identifier: BSD-3-Clause
// Nodes and cells of regular meshes.
#include "surface/layout.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace luff::surface {

void check_divisions(std::string_view shape, const std::array<int, 2>& divisions)
{
  if (divisions[0] < 1 || divisions[1] < 1)
    fail_input("{}: divisions = [{}, {}] must both be at least 1", shape, divisions[0], divisions[1]);
  // Corners are numbered by ints.
  constexpr double most = 1e8;
  if (double(divisions[0]) * divisions[1] > most)
    fail_input("{}: divisions = [{}, {}] make more than {:g} cells; take fewer", shape, divisions[0], divisions[1],
               most);
}

namespace {

std::map<std::string, Side> grid_sides(int columns, int rows, bool closed)
{
  std::map<std::string, Side> sides;
  for (int i = 0; i < columns; ++i) {
    sides["v_min"].nodes.push_back(i * rows);
    sides["v_max"].nodes.push_back(i * rows + rows - 1);
  }
  sides["v_min"].closed = sides["v_max"].closed = closed;
  for (int j = 0; j < rows && !closed; ++j) {
    sides["u_min"].nodes.push_back(j);
    sides["u_max"].nodes.push_back((columns - 1) * rows + j);
  }
  return sides;
}

}  // namespace

double graded(double fraction, double growth)
{
  return growth == 1 ? fraction : (std::pow(growth, fraction) - 1) / (growth - 1);
}

Layout grid_layout(const std::array<int, 2>& divisions, Around around)
{
  const auto [nu, nv] = divisions;
  const bool closed = around == Around::Closed;
  const int columns = closed ? nu : nu + 1;
  Layout layout;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j <= nv; ++j) {
      const bool inner = (closed || (i > 0 && i < nu)) && j > 0 && j < nv;
      layout.nodes.push_back({.u = double(i), .v = double(j), .du = 1, .dv = 1, .inner = inner});
    }
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const int p = i * (nv + 1) + j;
      const int q = (i + 1) % columns * (nv + 1) + j;
      layout.quadrilaterals.push_back({p, q, q + 1, p + 1});
    }
  layout.sides = grid_sides(columns, nv + 1, closed);
  return layout;
}

namespace {

class FanBuilder {
 public:
  explicit FanBuilder(const Fan& fan) : fan_(fan) {}

  Layout build()
  {
    for (int k = 0; k <= fan_.rings; ++k)
      add_ring(k);
    for (int k = 0; k < fan_.rings; ++k)
      for (int sector = 0; sector < fan_.sectors; ++sector)
        stitch(k, sector);
    name_sides();
    return std::move(layout_);
  }

 private:
  /// Intervals of one sector.
  int intervals(int ring) const { return std::min(ring, fan_.rings_to_far_pole - ring); }
  bool closed() const { return fan_.around == Around::Closed; }

  void add_ring(int k)
  {
    first_.push_back(static_cast<int>(layout_.nodes.size()));
    const int n = fan_.sectors * intervals(k);
    if (n == 0) {
      layout_.nodes.push_back({.u = double(k), .inner = closed()});
      return;
    }
    for (int c = 0; c < n + (closed() ? 0 : 1); ++c) {
      const bool inner = k < fan_.rings && (closed() || (c > 0 && c < n));
      layout_.nodes.push_back({.u = double(k), .v = double(c) / n, .du = 1, .dv = 1.0 / n, .inner = inner});
    }
  }

  int node(int ring, int sector, int c) const
  {
    const int n = fan_.sectors * intervals(ring);
    const int around = sector * intervals(ring) + c;
    return first_[ring] + (n == 0 ? 0 : closed() ? around % n : around);
  }

  /// Joins ring k to the next within a sector, each time along the shorter of the two possible edges.
  void stitch(int k, int sector)
  {
    const int n_in = intervals(k), n_out = intervals(k + 1);
    for (int in = 0, out = 0; in < n_in || out < n_out;) {
      const int p = node(k, sector, in), q = node(k + 1, sector, out);
      const bool step_out = in == n_in || (out < n_out && (2 * out + 1) * n_in <= (2 * in + 1) * n_out);
      if (step_out)
        layout_.triangles.push_back({p, q, node(k + 1, sector, ++out)});
      else
        layout_.triangles.push_back({p, q, node(k, sector, ++in)});
    }
  }

  void name_sides()
  {
    const int end = static_cast<int>(layout_.nodes.size());
    layout_.sides["u_min"].nodes = {0};
    for (int node = first_.back(); node < end; ++node)
      layout_.sides["u_max"].nodes.push_back(node);
    layout_.sides["u_max"].closed = closed();
    for (int k = 0; k <= fan_.rings && !closed(); ++k) {
      layout_.sides["v_min"].nodes.push_back(first_[k]);
      layout_.sides["v_max"].nodes.push_back(k < fan_.rings ? first_[k + 1] - 1 : end - 1);
    }
  }

  const Fan& fan_;
  Layout layout_;
  std::vector<int> first_;  ///< node of each ring
};

}  // namespace

Layout fan_layout(const Fan& fan)
{
  return FanBuilder(fan).build();
}

}  // namespace luff::surface

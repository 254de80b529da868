// SPDX-License-Identifier: BSD-3-Clause
#include "grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace luff::grid {

namespace {

Index3 count_cells(const std::array<std::vector<double>, 3>& faces)
{
  Index3 cells{};
  for (int a = 0; a < 3; ++a) {
    ensure(faces[a].size() >= 2, "an axis needs two face coordinates");
    cells[a] = static_cast<int>(faces[a].size()) - 1;
  }
  return cells;
}

}  // namespace

Grid::Grid(MPI_Comm comm, std::array<std::vector<double>, 3> faces, const std::array<bool, 3>& periodic)
    : ranks_(comm, count_cells(faces), periodic), faces_(std::move(faces))
{
  for (int a = 0; a < 3; ++a)
    make_axis(a);
  make_metrics();
}

Grid::Grid(MPI_Comm comm, const Index3& cells, const NodeSource& nodes, const std::array<bool, 3>& periodic)
    : ranks_(comm, cells, periodic), kind_(Kind::Curvilinear), body_fitted_(std::make_unique<BodyFitted>(ranks_, nodes))
{
  smallest_width_ = body_fitted_->smallest_width();
}

Vec3 Grid::centre_of_any(const Index3& c) const
{
  const Vec3 here = owned().contains(c) ? centre(c) : Vec3(Vec3::Zero());
  return {ranks_.sum(here[0]), ranks_.sum(here[1]), ranks_.sum(here[2])};
}

Vec3 Grid::face_centre(int axis, int i, int j, int k) const
{
  if (kind_ == Kind::Curvilinear)
    return body_fitted_->face_centre(axis, i, j, k);
  const Index3 c{i, j, k};
  Vec3 x;
  for (int a = 0; a < 3; ++a)
    x[a] = a == axis ? face(a, c[a]) : centre(a, c[a]);
  return x;
}

double Grid::area(int axis, int i, int j, int k) const
{
  if (kind_ == Kind::Curvilinear)
    return body_fitted_->area_vector(axis, i, j, k).norm();
  const Index3 c{i, j, k};
  const int b = (axis + 1) % 3;
  const int e = (axis + 2) % 3;
  return width(b, c[b]) * width(e, c[e]);
}

void Grid::make_axis(int axis)
{
  const int n = cells()[axis];
  const std::vector<double>& x = faces_[axis];
  KernelVector<double>& h = widths_[axis];
  h.resize(n + 2);
  centres_[axis].resize(n + 2);
  for (int i = 0; i < n; ++i) {
    h[i + 1] = x[i + 1] - x[i];
    if (!(h[i + 1] > 0.0))
      fail_input("grid axis {}: face {} at {} does not lie above face {} at {}", "xyz"[axis], i + 1, x[i + 1], i, x[i]);
    centres_[axis][i + 1] = 0.5 * (x[i] + x[i + 1]);
  }
  const bool wraps = ranks_.periodic(axis);
  h.front() = wraps ? h[n] : h[1];
  h.back() = wraps ? h[1] : h[n];
  centres_[axis].front() = x.front() - 0.5 * h.front();
  centres_[axis].back() = x.back() + 0.5 * h.back();

  KernelVector<double>& d = distances_[axis];
  d.resize(n + 1);
  for (int i = 0; i <= n; ++i)
    d[i] = 0.5 * (h[i] + h[i + 1]);
  const auto inverse = [](const KernelVector<double>& values) {
    KernelVector<double> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [](double v) { return 1.0 / v; });
    return result;
  };
  inverse_widths_[axis] = inverse(h);
  inverse_distances_[axis] = inverse(d);
}

void Grid::make_metrics()
{
  kind_ = Kind::Uniform;
  smallest_width_ = std::numeric_limits<double>::max();
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax_element(widths_[a].begin(), widths_[a].end());
    smallest_width_ = std::min(smallest_width_, *low);
    // Widths of equal cells differ by the rounding of their face coordinates.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                            std::max(std::abs(faces_[a].front()), std::abs(faces_[a].back()));
    if (*high - *low > rounding)
      kind_ = Kind::Rectilinear;
    uniform_.h[a] = length(a) / cells()[a];
    uniform_.inverse_h[a] = 1.0 / uniform_.h[a];
    rectilinear_.h[a] = widths_[a].data() + 1;
    rectilinear_.inverse_h[a] = inverse_widths_[a].data() + 1;
    rectilinear_.d[a] = distances_[a].data();
    rectilinear_.inverse_d[a] = inverse_distances_[a].data();
  }
}

}  // namespace luff::grid

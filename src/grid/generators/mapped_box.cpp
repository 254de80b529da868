// SPDX-License-Identifier: BSD-3-Clause
#include "grid/generators/mapped_box.hpp"

#include <cmath>

#include "core/error.hpp"

namespace luff::grid {

namespace {

Index3 cells_of(const std::vector<double>& xi, const std::vector<double>& eta, const std::vector<double>& zeta)
{
  ensure(xi.size() >= 2 && eta.size() >= 2 && zeta.size() >= 2, "an axis needs two nodes");
  return {static_cast<int>(xi.size()) - 1, static_cast<int>(eta.size()) - 1, static_cast<int>(zeta.size()) - 1};
}

/// Coordinates along one direction of the annulus's section.
std::vector<Vec3> directions(const AnnulusShape& shape)
{
  std::vector<Vec3> result;
  for (const double angle : shape.angles)
    result.push_back(std::cos(angle) * shape.start.e1 + std::sin(angle) * shape.start.e2);
  // Rounding of the angles in degrees.
  if (shape.angles.back() - shape.angles.front() > (1.0 - 1e-12) * 2.0 * std::numbers::pi)
    result.back() = result.front();
  return result;
}

struct Walls {
  double lower = 0.0;
  double upper = 0.0;
};

std::vector<Walls> walls_along(const ChannelShape& shape)
{
  std::vector<Walls> walls;
  for (const double x : shape.x) {
    walls.push_back({shape.lower(x), shape.upper(x)});
    const Walls& w = walls.back();
    if (!std::isfinite(w.lower) || !std::isfinite(w.upper) || !(w.lower < w.upper))
      fail_input("the channel's walls at x = {:.6g} are at y = {:.6g} and {:.6g}; the lower must lie below the upper",
                 x, w.lower, w.upper);
  }
  return walls;
}

}  // namespace

CurvilinearNodes make_mapped_box(std::array<std::vector<double>, 3> faces, std::function<Vec3(const Vec3&)> map)
{
  const Index3 cells = cells_of(faces[0], faces[1], faces[2]);
  return {cells, node_source([faces = std::move(faces), map = std::move(map)](int i, int j, int k) {
            return map({faces[0][i], faces[1][j], faces[2][k]});
          })};
}

CurvilinearNodes make_annulus(const AnnulusShape& shape)
{
  const Index3 cells = cells_of(shape.radii, shape.angles, shape.heights);
  return {cells, node_source([shape, outwards = directions(shape)](int i, int j, int k) -> Vec3 {
            return shape.start.x + shape.radii[i] * outwards[j] + shape.heights[k] * shape.start.t;
          })};
}

CurvilinearNodes make_channel(const ChannelShape& shape)
{
  const Index3 cells = cells_of(shape.x, shape.fractions, shape.z);
  return {cells, node_source([shape, walls = walls_along(shape)](int i, int j, int k) -> Vec3 {
            const Walls& w = walls[i];
            return {shape.x[i], w.lower + shape.fractions[j] * (w.upper - w.lower), shape.z[k]};
          })};
}

}  // namespace luff::grid

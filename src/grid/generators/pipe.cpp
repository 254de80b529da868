// SPDX-License-Identifier: BSD-3-Clause
#include "grid/generators/pipe.hpp"

#include <cmath>

#include "core/error.hpp"
#include "grid/generators/disc_section.hpp"

namespace luff::grid {

namespace {

struct Station {
  double s = 0.0;
  double radius = 0.0;
  CurvePoint frame;
};

std::vector<Station> make_stations(const PipeShape& shape)
{
  std::vector<Station> stations;
  for (const double s : shape.stations) {
    const double r = shape.radius(s);
    if (!(r > 0.0) || !std::isfinite(r))
      fail_input("the radius of the pipe at s = {:.6g} is {}; it must be greater than 0 from s = 0 to {:.6g}", s, r,
                 shape.stations.back());
    const double k = shape.centreline.curvature(s);
    if (k * r >= 1.0)
      fail_input(
          "the pipe folds at s = {:.6g}: its radius {:.6g} must be less than the radius {:.6g} of its bend there", s, r,
          1.0 / k);
    stations.push_back({s, r, shape.centreline.at(s)});
  }
  return stations;
}

}  // namespace

CurvilinearNodes make_pipe(PipeShape shape)
{
  ensure(shape.stations.size() >= 2, "a pipe has two stations at least");
  const int n = shape.across;
  const Index3 cells{n, n, static_cast<int>(shape.stations.size()) - 1};
  return {cells, node_source([n, bulge = shape.bulge, section = disc_section(n), stations = make_stations(shape)](
                                 int i, int j, int k) -> Vec3 {
            const Station& station = stations[k];
            const Eigen::Vector2d& P = section[i + j * (n + 1)];
            const double b = bulge ? bulge(station.s, std::atan2(P[1], P[0])) : 0.0;
            const Eigen::Vector2d X = P * (station.radius + b * P.squaredNorm());
            return station.frame.x + X[0] * station.frame.e1 + X[1] * station.frame.e2;
          })};
}

}  // namespace luff::grid

// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/checkpoint_parts.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace luff::simulation {

Shape shape_of_mesh(const std::string& name, const surface::TriangleMesh& mesh)
{
  const Eigen::VectorXd x = surface::interleaved(mesh.vertices);
  return {"the mesh of '" + name + "'", "mesh/" + name, {x.begin(), x.end()}};
}

void require_same_shapes(const output::CheckpointReader& file, const std::vector<Shape>& shapes)
{
  constexpr double round_off = 1e-9;
  for (const Shape& shape : shapes) {
    std::vector<double> before;
    file.value(shape.name, before);
    double size = 0.0;
    for (const double x : before)
      size = std::max(size, std::abs(x));
    bool same = before.size() == shape.numbers.size();
    for (std::size_t n = 0; same && n < before.size(); ++n)
      same = std::abs(before[n] - shape.numbers[n]) <= round_off * size;
    if (!same)
      fail_input("--restart: {} is not what it was when the checkpoint was written, so its run cannot go on",
                 shape.what);
  }
}

}  // namespace luff::simulation

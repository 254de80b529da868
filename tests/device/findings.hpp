// SPDX-License-Identifier: BSD-3-Clause
// What a program found, to compare with what another one finds.
#pragma once

#include <string>
#include <vector>

#include "grid/grid.hpp"

namespace luff::test {

struct Finding {
  std::string name;
  double tolerance;  ///< of the largest difference, in parts of the largest value
  std::vector<double> values;
};
using Findings = std::vector<Finding>;

/// Values of owned cells, or of a layer more.
inline std::vector<double> values_of(const View<const double>& field, const IndexBox& box)
{
  std::vector<double> values;
  for_each_cell_in_order(box, [&](int i, int j, int k) { values.push_back(field(i, j, k)); });
  return values;
}

/// The processor's rounding of one cell's terms, some hundred of them, where its compiler contracts products and sums.
constexpr double rounding = 1e-13;

/// Architecture of the GPU that cells run on, 90 for 9.0; 0 on the processor.
[[nodiscard]] int architecture_of_cells();

/// One pass of every kernel in operators/, fields where a GPU runs them and the processor cannot reach.
void find_operators(const std::string& name, const grid::Grid& grid, Findings& found);

/// A few steps of whole flows.
void find_flows(Findings& found);

}  // namespace luff::test

// SPDX-License-Identifier: BSD-3-Clause
// A grid as people look at it.
#pragma once

#include <string>
#include <type_traits>

#include "grid/grid.hpp"
#include "output/snapshot.hpp"

namespace luff::simulation {

/// The nodes of this rank's piece, without fields.
[[nodiscard]] output::FlowSnapshot grid_snapshot(const grid::Grid& grid);

/// The same with what tells good cells from bad ones: volume, skew (largest cosine between faces) and aspect ratio.
[[nodiscard]] output::FlowSnapshot quality_snapshot(const grid::Grid& grid);

/// Values of `components` numbers per owned cell, i fastest.
template <class Value>
[[nodiscard]] output::NamedField cell_field(const std::string& name, int components, const IndexBox& box, Value value)
{
  std::vector<float> values;
  values.reserve(box.volume() * components);
  for_each_cell_in_order(box, [&](int i, int j, int k) {
    const auto v = value(Index3{i, j, k});
    if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
      values.push_back(static_cast<float>(v));
    else
      for (int d = 0; d < components; ++d)
        values.push_back(static_cast<float>(v[d]));
  });
  return {name, components, std::move(values)};
}

}  // namespace luff::simulation

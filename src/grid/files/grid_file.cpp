// SPDX-License-Identifier: BSD-3-Clause
#include "grid/files/grid_file.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/readable.hpp"
#include "grid/files/plot3d.hpp"
#include "grid/files/vtk_grid.hpp"

namespace luff::grid {

CurvilinearNodes open_grid_file(const std::filesystem::path& file)
{
  require_readable(file);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".vts")
    return open_vts(file);
  if (ending == ".vtk")
    return open_legacy_vtk(file);
  return open_plot3d(file);
}

}  // namespace luff::grid

// SPDX-License-Identifier: BSD-3-Clause
#include "grid/files/vtk_grid.hpp"

#include <array>

#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "core/error.hpp"
#include "grid/files/dimensions.hpp"
#include "vtk/reading.hpp"

namespace luff::grid {

namespace {

using Path = std::filesystem::path;
using Extent = std::array<int, 6>;  ///< first and last node along each direction, as VTK numbers them

Index3 first_node(const Extent& e)
{
  return {e[0], e[2], e[4]};
}

Index3 node_count(const Extent& e)
{
  return {e[1] - e[0] + 1, e[3] - e[2] + 1, e[5] - e[4] + 1};
}

std::vector<Vec3> nodes_of(vtkStructuredGrid& grid, const Path& file, const Index3& first, const IndexBox& box)
{
  Extent extent{};
  grid.GetExtent(extent.data());
  const Index3 n = node_count(extent);
  if (grid.GetPoints() == nullptr || grid.GetNumberOfPoints() != vtkIdType(n[0]) * n[1] * n[2])
    fail_input("{}: holds {} points for {} x {} x {} nodes; write the file again", file.string(),
               grid.GetNumberOfPoints(), n[0], n[1], n[2]);
  std::vector<Vec3> nodes;
  nodes.reserve(box.volume());
  for_each_cell_in_order(box, [&](int i, int j, int k) {
    std::array<int, 3> index{first[0] + i, first[1] + j, first[2] + k};
    nodes.emplace_back(grid.GetPoint(vtkStructuredData::ComputePointIdForExtent(extent.data(), index.data())));
  });
  return nodes;
}

CurvilinearNodes opened(const Path& file, const Extent& whole, NodeSource source)
{
  const Index3 n = node_count(whole);
  require_cells(n, file.string());
  return {{n[0] - 1, n[1] - 1, n[2] - 1}, std::move(source)};
}

}  // namespace

CurvilinearNodes open_vts(const Path& file)
{
  constexpr auto kind = "a structured grid (.vts)";
  Extent whole{0, -1, 0, -1, 0, -1};
  vtkNew<vtkXMLStructuredGridReader> header;
  vtk::read(*header, file, kind, [&](auto& reader) {
    reader.UpdateInformation();
    reader.GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
  });
  const Index3 first = first_node(whole);
  return opened(file, whole, [file, first](const IndexBox& box) {
    vtkNew<vtkXMLStructuredGridReader> reader;
    vtk::read(*reader, file, kind, [&](auto& r) {
      Extent part{};
      for (int a = 0; a < 3; ++a) {
        part[2 * a] = first[a] + box.lo[a];
        part[2 * a + 1] = first[a] + box.hi[a] - 1;
      }
      r.vtkAlgorithm::UpdateExtent(part.data());
    });
    return nodes_of(*reader->GetOutput(), file, first, box);
  });
}

CurvilinearNodes open_legacy_vtk(const Path& file)
{
  vtkNew<vtkStructuredGridReader> reader;
  vtk::read(*reader, file, "a structured grid (.vtk)", [](auto& r) { r.Update(); });
  vtkSmartPointer<vtkStructuredGrid> grid = reader->GetOutput();
  Extent whole{};
  grid->GetExtent(whole.data());
  return opened(file, whole,
                [file, grid, whole](const IndexBox& box) { return nodes_of(*grid, file, first_node(whole), box); });
}

}  // namespace luff::grid

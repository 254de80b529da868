// SPDX-License-Identifier: BSD-3-Clause
// Rectilinear and structured grids with data by cell, one piece per rank.
#include <numeric>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>

#include "core/error.hpp"
#include "output/atomic_file.hpp"
#include "output/series.hpp"
#include "output/vtk_data.hpp"
#include "parallel/agreement.hpp"

namespace luff::output {

namespace {

using Extent = std::array<int, 6>;

Extent extent_of(const IndexBox& box)
{
  return {box.lo[0], box.hi[0], box.lo[1], box.hi[1], box.lo[2], box.hi[2]};
}

Extent whole_extent(const RectilinearNodes& nodes)
{
  const auto last = [&](int axis) { return static_cast<int>(nodes[axis].size()) - 1; };
  return {0, last(0), 0, last(1), 0, last(2)};
}

Extent whole_extent(const CurvilinearPiece& nodes)
{
  return {0, nodes.cells[0], 0, nodes.cells[1], 0, nodes.cells[2]};
}

vtkSmartPointer<vtkDoubleArray> coordinates(const char* name, const std::vector<double>& nodes, int first, int last)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);  // else VTK makes one of its address, another one in every run
  for (int i = first; i <= last; ++i)
    array->InsertNextValue(nodes[i]);
  return array;
}

vtkSmartPointer<vtkRectilinearGrid> vtk_grid(const RectilinearNodes& nodes, const Extent& e)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetExtent(e[0], e[1], e[2], e[3], e[4], e[5]);
  grid->SetXCoordinates(coordinates("x", nodes[0], e[0], e[1]));
  grid->SetYCoordinates(coordinates("y", nodes[1], e[2], e[3]));
  grid->SetZCoordinates(coordinates("z", nodes[2], e[4], e[5]));
  return grid;
}

vtkSmartPointer<vtkStructuredGrid> vtk_grid(const CurvilinearPiece& nodes, const Extent& e)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(e[0], e[1], e[2], e[3], e[4], e[5]);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : nodes.points)
    points->InsertNextPoint(x.data());
  grid->SetPoints(points);
  return grid;
}

/// What VTK calls the grid, its writer, its file and its nodes.
struct RectilinearFormat {
  using Writer = vtkXMLRectilinearGridWriter;
  static constexpr auto name = "PRectilinearGrid";
  static constexpr auto ending = "vtr";
  static constexpr auto nodes =
      "    <PCoordinates>\n      <PDataArray type=\"Float64\" Name=\"x\"/>\n      <PDataArray type=\"Float64\" "
      "Name=\"y\"/>\n      <PDataArray type=\"Float64\" Name=\"z\"/>\n    </PCoordinates>\n";
};

struct StructuredFormat {
  using Writer = vtkXMLStructuredGridWriter;
  static constexpr auto name = "PStructuredGrid";
  static constexpr auto ending = "vts";
  static constexpr auto nodes =
      "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    </PPoints>\n";
};

RectilinearFormat format_of(const RectilinearNodes&)
{
  return {};
}

StructuredFormat format_of(const CurvilinearPiece&)
{
  return {};
}

/// ".vtr" or ".vts" without the dot.
std::string ending_of(const FlowSnapshot& snapshot)
{
  return std::visit([](const auto& nodes) { return std::string(format_of(nodes).ending); }, snapshot.nodes);
}

bool write_piece(const FlowSnapshot& snapshot, double time, const std::filesystem::path& file)
{
  return std::visit(
      [&](const auto& nodes) {
        const auto grid = vtk_grid(nodes, extent_of(snapshot.piece));
        add_fields(*grid->GetCellData(), snapshot.fields, snapshot.piece.volume());
        set_time(*grid, time);
        const auto writer = vtkSmartPointer<typename decltype(format_of(nodes))::Writer>::New();
        return write_vtk(*writer, *grid, file);
      },
      snapshot.nodes);
}

std::vector<Extent> gather_extents(MPI_Comm comm, const FlowSnapshot& snapshot)
{
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const Extent mine = extent_of(snapshot.piece);
  std::vector<Extent> all(ranks);
  MPI_Allgather(mine.data(), 6, MPI_INT, all.data(), 6, MPI_INT, comm);
  return all;
}

std::string text_of(const Extent& e)
{
  return fmt::format("{} {} {} {} {} {}", e[0], e[1], e[2], e[3], e[4], e[5]);
}

std::string piece_name(const std::string& stem, std::size_t rank, const std::string& ending)
{
  return fmt::format("{}_r{:04}.{}", stem, rank, ending);
}

/// The .pvtr or .pvts file, which says where the pieces lie and what is in them.
template <class Nodes>
std::string list_of_pieces(const std::string& stem, const Nodes& nodes, const FlowSnapshot& snapshot,
                           const std::vector<Extent>& extents)
{
  const auto format = format_of(nodes);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"0.1\">\n  <{} WholeExtent=\"{}\" GhostLevel=\"0\">\n"
      "    <PCellData>\n",
      format.name, format.name, text_of(whole_extent(nodes)));
  for (const NamedField& field : snapshot.fields)
    text += fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", vtk_type(field),
                        field.name, field.components);
  text += fmt::format("    </PCellData>\n{}", format.nodes);
  for (std::size_t rank = 0; rank < extents.size(); ++rank)
    text += fmt::format("    <Piece Extent=\"{}\" Source=\"{}\"/>\n", text_of(extents[rank]),
                        piece_name(stem, rank, format.ending));
  return text + fmt::format("  </{}>\n</VTKFile>\n", format.name);
}

int rank_in(MPI_Comm comm)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

}  // namespace

FlowSeries::FlowSeries(const RunFolder& folder, std::string name, const EarlierOutput* earlier)
    : folder_(folder), name_(std::move(name)), index_(folder, name_, earlier)
{
}

void FlowSeries::write(double time, const FlowSnapshot& snapshot)
{
  const std::string file = write_pieces(fmt::format("{}_{:06}", name_, index_.count()), time, snapshot);
  index_.add(time, fmt::format("{}/{}", name_, file));
}

/// Returns the name of the file that shows the whole grid.
std::string FlowSeries::write_pieces(const std::string& stem, double time, const FlowSnapshot& snapshot)
{
  const MPI_Comm comm = folder_.comm();
  const std::filesystem::path folder = folder_.file(name_);
  const std::vector<Extent> extents = gather_extents(comm, snapshot);
  std::error_code ignored;  // what matters is whether the pieces can be written
  if (folder_.writes())
    std::filesystem::create_directories(folder, ignored);
  MPI_Barrier(comm);

  const bool alone = extents.size() == 1;
  const std::string ending = ending_of(snapshot);
  std::string piece = alone ? fmt::format("{}.{}", stem, ending) : piece_name(stem, rank_in(comm), ending);
  if (!on_all_ranks(comm, write_piece(snapshot, time, folder / piece)))
    fail_run("{}: cannot be written at t = {}; is the disk full, or the folder gone?", (folder / stem).string(), time);
  if (alone)
    return piece;
  const std::string list = fmt::format("{}.p{}", stem, ending);
  if (folder_.writes())
    std::visit(
        [&](const auto& nodes) { write_atomically(folder / list, list_of_pieces(stem, nodes, snapshot, extents)); },
        snapshot.nodes);
  return list;
}

}  // namespace luff::output

// SPDX-License-Identifier: BSD-3-Clause
// Rectilinear grids with data by cell, one piece per rank.
#include <numeric>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkRectilinearGrid.h>
#include <vtkXMLRectilinearGridWriter.h>

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

Extent whole_extent(const FlowSnapshot& snapshot)
{
  const auto last = [&](int axis) { return static_cast<int>(snapshot.nodes[axis].size()) - 1; };
  return {0, last(0), 0, last(1), 0, last(2)};
}

vtkSmartPointer<vtkDoubleArray> coordinates(const char* name, const std::vector<double>& nodes, int first, int last)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);  // else VTK makes one of its address, another one in every run
  for (int i = first; i <= last; ++i)
    array->InsertNextValue(nodes[i]);
  return array;
}

vtkSmartPointer<vtkRectilinearGrid> vtk_grid(const FlowSnapshot& snapshot, double time)
{
  const Extent e = extent_of(snapshot.piece);
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetExtent(e[0], e[1], e[2], e[3], e[4], e[5]);
  grid->SetXCoordinates(coordinates("x", snapshot.nodes[0], e[0], e[1]));
  grid->SetYCoordinates(coordinates("y", snapshot.nodes[1], e[2], e[3]));
  grid->SetZCoordinates(coordinates("z", snapshot.nodes[2], e[4], e[5]));
  add_fields(*grid->GetCellData(), snapshot.fields, snapshot.piece.volume());
  set_time(*grid, time);
  return grid;
}

bool write_piece(const FlowSnapshot& snapshot, double time, const std::filesystem::path& file)
{
  const auto grid = vtk_grid(snapshot, time);
  const auto writer = vtkSmartPointer<vtkXMLRectilinearGridWriter>::New();
  return write_vtk(*writer, *grid, file);
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

std::string piece_name(const std::string& stem, std::size_t rank)
{
  return fmt::format("{}_r{:04}.vtr", stem, rank);
}

/// The .pvtr file, which says where the pieces lie and what is in them.
std::string list_of_pieces(const std::string& stem, const FlowSnapshot& snapshot, const std::vector<Extent>& extents)
{
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PRectilinearGrid\" version=\"0.1\">\n"
      "  <PRectilinearGrid WholeExtent=\"{}\" GhostLevel=\"0\">\n    <PCellData>\n",
      text_of(whole_extent(snapshot)));
  for (const NamedField& field : snapshot.fields)
    text += fmt::format("      <PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", vtk_type(field),
                        field.name, field.components);
  text += "    </PCellData>\n    <PCoordinates>\n";
  for (const char axis : {'x', 'y', 'z'})
    text += fmt::format("      <PDataArray type=\"Float64\" Name=\"{}\"/>\n", axis);
  text += "    </PCoordinates>\n";
  for (std::size_t rank = 0; rank < extents.size(); ++rank)
    text += fmt::format("    <Piece Extent=\"{}\" Source=\"{}\"/>\n", text_of(extents[rank]), piece_name(stem, rank));
  return text + "  </PRectilinearGrid>\n</VTKFile>\n";
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
  std::string piece = alone ? stem + ".vtr" : piece_name(stem, rank_in(comm));
  if (!on_all_ranks(comm, write_piece(snapshot, time, folder / piece)))
    fail_run("{}: cannot be written at t = {}; is the disk full, or the folder gone?", (folder / stem).string(), time);
  if (alone)
    return piece;
  if (folder_.writes())
    write_atomically(folder / (stem + ".pvtr"), list_of_pieces(stem, snapshot, extents));
  return stem + ".pvtr";
}

}  // namespace luff::output

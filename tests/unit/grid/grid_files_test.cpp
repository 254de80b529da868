// SPDX-License-Identifier: BSD-3-Clause
// Grids read from files are those that were written; what is wrong with a file is told.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>

#include "core/error.hpp"
#include "grid/files/grid_file.hpp"

namespace luff::grid {
namespace {

constexpr Index3 size{4, 3, 5};  // nodes
constexpr int count = 60;
const IndexBox everything{{0, 0, 0}, size};

Vec3 node(int i, int j, int k)
{
  return {0.1 * i + 0.01 * j * k, 0.2 * j - 0.03 * i * i, 1.0 / 3.0 * k + 0.05 * i};
}

/// How a PLOT3D file is written.
struct Writing {
  bool records = false;
  bool swapped = false;
  bool single = false;
  bool counted = false;
  bool blanked = false;
  int marker = 4;          ///< bytes
  int largest_record = 0;  ///< beyond which records are split; none: 0
};

template <class Number>
void append(std::string& bytes, Number value, bool swapped)
{
  std::string text(sizeof(Number), '\0');
  std::memcpy(text.data(), &value, sizeof(Number));
  if (swapped)
    std::reverse(text.begin(), text.end());
  bytes += text;
}

void append_marker(std::string& bytes, std::int64_t value, const Writing& how)
{
  if (how.marker == 8)
    append(bytes, value, how.swapped);
  else
    append(bytes, static_cast<std::int32_t>(value), how.swapped);
}

/// A record as gfortran writes it: the leading marker of a part is negative when another follows, the trailing one when
/// another went before.
void append_record(std::string& bytes, const std::string& record, const Writing& how)
{
  if (!how.records) {
    bytes += record;
    return;
  }
  const std::size_t most = how.largest_record > 0 ? how.largest_record : record.size();
  for (std::size_t begin = 0; begin < record.size(); begin += most) {
    const std::string part = record.substr(begin, most);
    const auto length = static_cast<std::int64_t>(part.size());
    append_marker(bytes, begin + most < record.size() ? -length : length, how);
    bytes += part;
    append_marker(bytes, begin > 0 ? -length : length, how);
  }
}

std::string plot3d(const Writing& how)
{
  std::string bytes;
  std::string record;
  if (how.counted) {
    append(record, std::int32_t{1}, how.swapped);
    append_record(bytes, record, how);
  }
  record.clear();
  for (const int n : size)
    append(record, std::int32_t{n}, how.swapped);
  append_record(bytes, record, how);
  record.clear();
  for (int d = 0; d < 3; ++d)
    for_each_cell_in_order(everything, [&](int i, int j, int k) {
      if (how.single)
        append(record, static_cast<float>(node(i, j, k)[d]), how.swapped);
      else
        append(record, node(i, j, k)[d], how.swapped);
    });
  for (int n = 0; how.blanked && n < count; ++n)
    append(record, std::int32_t{1}, how.swapped);
  append_record(bytes, record, how);
  return bytes;
}

class GridFiles : public testing::Test {
 protected:
  GridFiles() { std::filesystem::create_directories(folder_); }
  ~GridFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  /// The grid of the file has the nodes of node(), whole and in part.
  static void expect_nodes(const std::filesystem::path& file, double rounding)
  {
    const CurvilinearNodes grid = open_grid_file(file);
    ASSERT_EQ(grid.cells, (Index3{size[0] - 1, size[1] - 1, size[2] - 1}));
    for (const IndexBox& box : {everything, IndexBox{{1, 0, 2}, {3, 2, 5}}, IndexBox{{3, 2, 4}, {4, 3, 5}}}) {
      const auto nodes = grid.source(box);
      ASSERT_EQ(std::ssize(nodes), box.volume());
      std::size_t n = 0;
      for_each_cell_in_order(box, [&](int i, int j, int k) {
        EXPECT_LE((nodes[n++] - node(i, j, k)).norm(), rounding) << i << ' ' << j << ' ' << k;
      });
    }
  }

  /// The message with which the file is refused, without its folder; nothing may be printed.
  std::string refusal(const std::filesystem::path& file) const
  {
    testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      (void)open_grid_file(file).source(everything);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    const std::string folder = folder_.string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("luff-grid-files-" + std::to_string(::getpid()));
};

TEST_F(GridFiles, InPlot3dAreReadInEveryLayoutOfNumbers)
{
  int files = 0;
  for (const int kind : {0, 4, 8})  // bytes of markers
    for (const bool swapped : {false, true})
      for (const bool single : {false, true})
        for (const bool counted : {false, true})
          for (const bool blanked : {false, true}) {
            const Writing how{.records = kind > 0,
                              .swapped = swapped,
                              .single = single,
                              .counted = counted,
                              .blanked = blanked,
                              .marker = kind > 0 ? kind : 4};
            SCOPED_TRACE(testing::Message() << "markers " << kind << " swapped " << swapped << " single " << single
                                            << " counted " << counted << " blanked " << blanked);
            expect_nodes(write("grid.xyz", plot3d(how)), single ? 2e-7 : 0.0);
            ++files;
          }
  EXPECT_EQ(files, 48);
}

TEST_F(GridFiles, InPlot3dMayHaveSplitRecords)
{
  for (const int marker : {4, 8})
    expect_nodes(write("grid.xyz", plot3d({.records = true, .counted = true, .marker = marker, .largest_record = 100})),
                 0.0);
}

std::string plot3d_text(const std::string& head)
{
  std::ostringstream text;
  text.precision(17);
  text << head << "4 3 5\n";
  int n = 0;
  for (int d = 0; d < 3; ++d)
    for_each_cell_in_order(everything,
                           [&](int i, int j, int k) { text << node(i, j, k)[d] << (++n % 6 == 0 ? "\n" : "  "); });
  return text.str();
}

TEST_F(GridFiles, InPlot3dMayBeText)
{
  expect_nodes(write("grid.p3d", plot3d_text("")), 1e-16);
  expect_nodes(write("grid.p3d", plot3d_text("  1\n\n")), 1e-16);
}

TEST_F(GridFiles, InPlot3dTextMayHaveFortransExponentsAndRepeats)
{
  const auto file = write("grid.p3d", "2, 2, 2\n0.0 +1.0D0 0d0 1 0 1.0E+00, 0 1\n2*0 2*1 2*0. 2*1\n4*0 4*-2.5d-1\n");
  const CurvilinearNodes grid = open_grid_file(file);
  const auto nodes = grid.source({{0, 0, 0}, {2, 2, 2}});
  for (int n = 0; n < 8; ++n)
    EXPECT_EQ(nodes[n], Vec3(n & 1, n >> 1 & 1, n >> 2 == 1 ? -0.25 : 0.0));
}

vtkSmartPointer<vtkStructuredGrid> vtk_grid()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for_each_cell_in_order(everything, [&](int i, int j, int k) { points->InsertNextPoint(node(i, j, k).data()); });
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(3, 6, 0, 2, -1, 3);  // VTK may number nodes from anywhere
  grid->SetPoints(points);
  return grid;
}

TEST_F(GridFiles, OfVtkAreReadInBothFormats)
{
  vtkNew<vtkXMLStructuredGridWriter> xml;
  xml->SetInputData(vtk_grid());
  xml->SetFileName((folder_ / "grid.vts").c_str());
  xml->Write();
  expect_nodes(folder_ / "grid.vts", 0.0);
  vtkNew<vtkStructuredGridWriter> legacy;
  legacy->SetInputData(vtk_grid());
  legacy->SetFileTypeToBinary();
  legacy->SetFileName((folder_ / "grid.vtk").c_str());
  legacy->Write();
  expect_nodes(folder_ / "grid.vtk", 0.0);
}

TEST_F(GridFiles, ThatAreMissingOrEmptyAreRefused)
{
  EXPECT_NE(refusal(folder_ / "none.xyz").find("there is no such file"), std::string::npos);
  EXPECT_EQ(refusal(write("grid.xyz", "")), "grid.xyz: is empty");
}

TEST_F(GridFiles, InPlot3dThatAreCutShortAreRefused)
{
  const std::string binary = plot3d({});
  EXPECT_EQ(refusal(write("grid.xyz", binary.substr(0, binary.size() - 8))),
            "grid.xyz: 4 x 3 x 5 nodes take 720 bytes in single or 1440 in double precision; after its 12 bytes of "
            "dimensions the file has 1432");
  const std::string records = plot3d({.records = true});
  EXPECT_EQ(refusal(write("grid.xyz", records.substr(0, records.size() - 100))),
            "grid.xyz: is cut short: record 2 at byte 20 has 1440 bytes, of which the file holds 1344");
  EXPECT_EQ(refusal(write("grid.xyz", records.substr(0, 22))),
            "grid.xyz: ends within the marker of record 2, at byte 20");
  EXPECT_EQ(refusal(write("grid.xyz", records.substr(0, 20))),
            "grid.xyz: has 1 record(s); a grid of one block has its dimensions in one and its coordinates in another");
  const std::string text = plot3d_text("");
  EXPECT_EQ(refusal(write("grid.xyz", text.substr(0, text.rfind(' ')))),
            "grid.xyz: ends after 179 coordinates; 4 x 3 x 5 nodes have 180");
}

TEST_F(GridFiles, InPlot3dOfAnotherSizeThanTheirsAreRefused)
{
  std::string records = plot3d({.records = true});
  const std::int32_t wrong = 7;
  std::memcpy(records.data() + 4, &wrong, 4);
  EXPECT_EQ(refusal(write("grid.xyz", records)),
            "grid.xyz: 7 x 3 x 5 nodes take 1260 bytes in single or 2520 in double precision; the record of its "
            "coordinates has 1440");
  std::string damaged = plot3d({.records = true});
  damaged.back() = 1;
  EXPECT_NE(refusal(write("grid.xyz", damaged)).find("it is damaged"), std::string::npos);
}

TEST_F(GridFiles, InPlot3dWithSeveralBlocksAreRefused)
{
  constexpr auto complaint = "grid.xyz: holds 2 blocks; a grid is read from a file with one block: split the file";
  EXPECT_EQ(refusal(write("grid.xyz", "2\n2 2 2\n2 2 2\n")), complaint);
  std::string records = plot3d({.records = true, .counted = true});
  const std::int32_t two = 2;
  std::memcpy(records.data() + 4, &two, 4);
  EXPECT_EQ(refusal(write("grid.xyz", records)), complaint);
  std::string binary;
  for (const std::int32_t n : {2, 2, 2, 2, 3, 2, 2})
    append(binary, n, false);
  binary += std::string(20 * 24, '\0');
  EXPECT_EQ(refusal(write("grid.xyz", binary)), complaint);
}

TEST_F(GridFiles, ThatHoldSomethingElseAreRefused)
{
  EXPECT_EQ(refusal(write("grid.p3d", "3 3\n1 2 3\n")),
            "grid.p3d: begins with 2 numbers on a line; a grid begins with its three numbers of nodes, or with the "
            "number of blocks on a line of its own");
  EXPECT_EQ(refusal(write("grid.p3d", "2 2 1\n1 2 3\n")),
            "grid.p3d: holds 2 x 2 x 1 nodes; a grid has two at least along each direction");
  EXPECT_EQ(refusal(write("grid.p3d", "2 2 2\n1 2\n3 4e 5\n")), "grid.p3d:3: '4e' must be a coordinate");
  EXPECT_EQ(refusal(write("grid.p3d", "2 2.5 2\n1 2\n3 4e 5\n")),
            "grid.p3d:1: '2.5' must be a number of blocks or nodes");
  EXPECT_NE(refusal(write("grid.xyz", "solid thing\n  facet normal 0 0 1\n")).find("is no PLOT3D grid"),
            std::string::npos);
  EXPECT_NE(refusal(write("grid.vts", "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\"></VTKFile>"))
                .find("cannot be read as a structured grid (.vts)"),
            std::string::npos);
  EXPECT_NE(
      refusal(write("grid.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n"))
          .find("cannot be read as a structured grid (.vtk)"),
      std::string::npos);
}

TEST_F(GridFiles, OfVtkThatAreCutShortAreRefused)
{
  vtkNew<vtkXMLStructuredGridWriter> xml;
  xml->SetInputData(vtk_grid());
  xml->SetFileName((folder_ / "whole.vts").c_str());
  xml->SetDataModeToAppended();
  xml->EncodeAppendedDataOff();
  xml->Write();
  std::ifstream in(folder_ / "whole.vts", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(refusal(write("grid.vts", whole.substr(0, whole.size() / 2))), "accepted");
}

}  // namespace
}  // namespace luff::grid

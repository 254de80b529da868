// SPDX-License-Identifier: BSD-3-Clause
// Series of flow and surface snapshots, read back with VTK's own readers.
#include "output/series.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLPRectilinearGridReader.h>
#include <vtkXMLPStructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "core/error.hpp"
#include "sample_snapshots.hpp"
#include "scratch_folder.hpp"

namespace luff::output::test {
namespace {

const Index3 cells{7, 5, 4};

/// Slabs along z, or the whole on one rank.
IndexBox piece_of(int rank, int ranks)
{
  return {{0, 0, cells[2] * rank / ranks}, {cells[0], cells[1], cells[2] * (rank + 1) / ranks}};
}

class Series : public testing::Test {
 protected:
  Series()
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  }
  FlowSnapshot flow(double t) const { return sample_flow(cells, piece_of(rank, ranks), t); }
  std::string flow_file(int count) const
  {
    return "fields/fields_00000" + std::to_string(count) + (ranks == 1 ? ".vtr" : ".pvtr");
  }

  ScratchFolder scratch{MPI_COMM_WORLD};
  RunFolder folder = RunFolder::at(MPI_COMM_WORLD, scratch.path() / "run");
  int rank = 0;
  int ranks = 1;
};

void expect_sample(vtkRectilinearGrid& grid, const IndexBox& piece)
{
  const auto nodes = std::get<RectilinearNodes>(sample_flow(cells, piece).nodes);
  ASSERT_EQ(grid.GetNumberOfCells(), piece.volume());
  for (int i = piece.lo[2]; i <= piece.hi[2]; ++i)
    EXPECT_EQ(grid.GetZCoordinates()->GetTuple1(i - piece.lo[2]), nodes[2][i]);
  for (int i = 0; i <= cells[0]; ++i)
    EXPECT_EQ(grid.GetXCoordinates()->GetTuple1(i), nodes[0][i]);
  auto* velocity = grid.GetCellData()->GetArray("velocity");
  auto* pressure = grid.GetCellData()->GetArray("pressure");
  ASSERT_TRUE(velocity && pressure);
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    double b[6];
    grid.GetCellBounds(c, b);
    EXPECT_FLOAT_EQ(velocity->GetComponent(c, 0), static_cast<float>(0.5 * (b[0] + b[1])));
    EXPECT_FLOAT_EQ(velocity->GetComponent(c, 1), static_cast<float>(0.5 * (b[2] + b[3])));
    EXPECT_FLOAT_EQ(velocity->GetComponent(c, 2), static_cast<float>(0.5 * (b[4] + b[5])));
    EXPECT_NEAR(pressure->GetComponent(c, 0), 50 * (b[0] + b[1]) + 5 * (b[2] + b[3]) + 0.5 * (b[4] + b[5]), 1e-12);
  }
}

TEST_F(Series, EveryPieceOfAFlowHoldsItsOwnCellsAtTheirPlaces)
{
  FlowSeries(folder).write(0, flow(0));
  MPI_Barrier(MPI_COMM_WORLD);
  for (int r = 0; r < ranks; ++r) {
    const std::string piece = ranks == 1 ? flow_file(0) : "fields/fields_000000_r000" + std::to_string(r) + ".vtr";
    vtkNew<vtkXMLRectilinearGridReader> reader;
    reader->SetFileName(folder.file(piece).c_str());
    reader->Update();
    expect_sample(*reader->GetOutput(), piece_of(r, ranks));
  }
}

TEST_F(Series, ThePiecesReadTogetherAreTheWholeFlow)
{
  FlowSeries(folder).write(0, flow(0));
  MPI_Barrier(MPI_COMM_WORLD);
  if (ranks == 1 || rank != 0)
    return;
  vtkNew<vtkXMLPRectilinearGridReader> reader;
  reader->SetFileName(folder.file(flow_file(0)).c_str());
  reader->Update();
  expect_sample(*reader->GetOutput(), {{0, 0, 0}, cells});
}

TEST_F(Series, ThePiecesOfACurvilinearFlowAreTheWholeAtItsPlaces)
{
  FlowSeries(folder).write(0, sample_curvilinear_flow(cells, piece_of(rank, ranks)));
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank != 0)
    return;
  vtkNew<vtkXMLStructuredGridReader> alone;
  vtkNew<vtkXMLPStructuredGridReader> together;
  vtkXMLReader& reader = ranks == 1 ? static_cast<vtkXMLReader&>(*alone) : *together;
  reader.SetFileName(folder.file(ranks == 1 ? "fields/fields_000000.vts" : "fields/fields_000000.pvts").c_str());
  reader.Update();
  auto& grid = *vtkStructuredGrid::SafeDownCast(reader.GetOutputAsDataSet());
  const IndexBox whole{{0, 0, 0}, cells};
  const FlowSnapshot expected = sample_curvilinear_flow(cells, whole);
  ASSERT_EQ(grid.GetNumberOfCells(), whole.volume());
  const auto& points = std::get<CurvilinearPiece>(expected.nodes).points;
  ASSERT_EQ(grid.GetNumberOfPoints(), std::ssize(points));
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n)
    EXPECT_EQ(Vec3(grid.GetPoint(n)), points[n]);
  const auto& velocity = std::get<std::vector<float>>(expected.fields[0].values);
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    for (int d = 0; d < 3; ++d)
      EXPECT_EQ(grid.GetCellData()->GetArray("velocity")->GetComponent(c, d), velocity[3 * c + d]);
}

TEST_F(Series, TheIndexListsEveryInstantWrittenAndIsWholeAfterEach)
{
  FlowSeries series(folder);
  for (int n = 0; n < 3; ++n) {
    series.write(0.5 * n, flow(0.5 * n));
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string text = text_of(folder.file("fields.pvd"));
    for (int m = 0; m <= n; ++m)
      EXPECT_NE(text.find("file=\"" + flow_file(m) + "\""), std::string::npos);
    EXPECT_EQ(text.find(flow_file(n + 1)), std::string::npos);
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  EXPECT_NE(text_of(folder.file("fields.pvd")).find("timestep=\"0.5\""), std::string::npos);
}

TEST_F(Series, ASurfaceKeepsPointsTrianglesAndFields)
{
  const SurfaceSnapshot sheet = sample_sheet(4, 0.3);
  SurfaceSeries series(folder, "shell-flag");
  series.write(0, sample_sheet(4));
  series.write(0.3, sheet);
  MPI_Barrier(MPI_COMM_WORLD);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("shell-flag/shell-flag_000001.vtp").c_str());
  reader->Update();
  vtkPolyData& read = *reader->GetOutput();
  ASSERT_EQ(read.GetNumberOfPoints(), 25);
  ASSERT_EQ(read.GetNumberOfCells(), 32);
  for (int v = 0; v < 25; ++v) {
    EXPECT_EQ(Vec3(read.GetPoint(v)), sheet.points[v]);
    EXPECT_EQ(read.GetPointData()->GetArray("displacement")->GetComponent(v, 1), sheet.points[v].y());
  }
  EXPECT_EQ(read.GetCell(3)->GetPointId(2), sheet.triangles[3][2]);
  EXPECT_EQ(read.GetCellData()->GetArray("load")->GetComponent(31, 0), 31);
  EXPECT_EQ(read.GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.3);
  EXPECT_NE(text_of(folder.file("shell-flag.pvd")).find("shell-flag/shell-flag_000001.vtp"), std::string::npos);
}

TEST_F(Series, APieceThatCannotBeWrittenEndsTheRunOnEveryRankAndWhatWasWrittenStaysListed)
{
  FlowSeries series(folder);
  series.write(0, flow(0));
  const std::string name = ranks == 1 ? "fields_000001.vtr" : "fields_000001_r0000.vtr";
  if (rank == 0)
    std::filesystem::create_directory(folder.file("fields") / name);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(series.write(1, flow(1)), RunError);
  EXPECT_NE(text_of(folder.file("fields.pvd")).find(flow_file(0)), std::string::npos);
  EXPECT_EQ(text_of(folder.file("fields.pvd")).find("fields_000001"), std::string::npos);
}

TEST_F(Series, AFolderRefusedOnOneRankIsRefusedOnAll)
{
  if (rank == 0)
    std::ofstream(folder.file("precious")) << "data";
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(RunFolder::at(MPI_COMM_WORLD, folder.path()), InputError);
}

TEST_F(Series, EveryRankLearnsTheNumberOfTheRun)
{
  const auto run = RunFolder::numbered(MPI_COMM_WORLD, scratch.path() / "runs", "flag");
  EXPECT_EQ(run.path(), scratch.path() / "runs" / "flag" / "001");
  EXPECT_EQ(run.writes(), rank == 0);
}

}  // namespace
}  // namespace luff::output::test

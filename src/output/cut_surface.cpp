// SPDX-License-Identifier: BSD-3-Clause
#include "output/cut_surface.hpp"

#include <numeric>

#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>

#include "core/error.hpp"
#include "output/vtk_data.hpp"

namespace luff::output {

namespace {

vtkSmartPointer<vtkStructuredGrid> vtk_block(const PointBlock& block)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : block.places)
    points->InsertNextPoint(x.data());
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(block.points[0], block.points[1], block.points[2]);
  grid->SetPoints(points);
  add_fields(*grid->GetPointData(), block.fields, block.places.size());
  return grid;
}

NamedField field_of(vtkDataArray* array, const NamedField& like)
{
  std::vector<float> values;
  values.reserve(array != nullptr ? array->GetNumberOfValues() : 0);
  for (vtkIdType n = 0; array != nullptr && n < array->GetNumberOfTuples(); ++n)
    for (int c = 0; c < like.components; ++c)
      values.push_back(static_cast<float>(array->GetComponent(n, c)));
  return {like.name, like.components, std::move(values)};
}

SurfaceSnapshot snapshot_of(vtkPolyData& surface, const PointBlock& block)
{
  SurfaceSnapshot snapshot;
  for (vtkIdType n = 0; n < surface.GetNumberOfPoints(); ++n)
    snapshot.points.emplace_back(surface.GetPoint(n));
  vtkNew<vtkIdList> corners;
  vtkCellArray* faces = surface.GetPolys();
  faces->InitTraversal();
  while (faces->GetNextCell(corners) != 0) {
    const auto corner = [&](int n) { return static_cast<int>(corners->GetId(n)); };
    ensure(corners->GetNumberOfIds() == 3, "VTK's filters make triangles");
    snapshot.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  for (const NamedField& field : block.fields)
    snapshot.point_fields.push_back(field_of(surface.GetPointData()->GetArray(field.name.c_str()), field));
  return snapshot;
}

/// Of all ranks, one after the other, on the first.
template <class Number>
std::vector<Number> gathered(const std::vector<Number>& mine, MPI_Datatype type, MPI_Comm comm)
{
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  std::vector<int> starts(ranks, 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<Number> all(rank == 0 ? starts.back() + counts.back() : 0);
  MPI_Gatherv(mine.data(), count, type, all.data(), counts.data(), starts.data(), type, 0, comm);
  return all;
}

/// How many points the ranks before this one have.
int points_before(const SurfaceSnapshot& piece, MPI_Comm comm)
{
  const int mine = static_cast<int>(piece.points.size());
  int up_to_here = 0;
  MPI_Scan(&mine, &up_to_here, 1, MPI_INT, MPI_SUM, comm);
  return up_to_here - mine;
}

}  // namespace

SurfaceSnapshot cut_by_plane(const PointBlock& block, const Vec3& point, const Vec3& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(point[0], point[1], point[2]);
  plane->SetNormal(normal[0], normal[1], normal[2]);
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(vtk_block(block));
  cutter->SetCutFunction(plane);
  cutter->GenerateTrianglesOn();
  cutter->Update();
  return snapshot_of(*cutter->GetOutput(), block);
}

SurfaceSnapshot surface_of_value(const PointBlock& block, std::span<const float> values, double value)
{
  const auto grid = vtk_block(block);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetName("value of the surface");
  for (const float v : values)
    scalars->InsertNextValue(v);
  grid->GetPointData()->SetScalars(scalars);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, value);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return snapshot_of(*contour->GetOutput(), block);
}

SurfaceSnapshot gathered(const SurfaceSnapshot& piece, MPI_Comm comm)
{
  std::vector<double> places;
  for (const Vec3& x : piece.points)
    places.insert(places.end(), x.begin(), x.end());
  std::vector<int> corners;
  const int first = points_before(piece, comm);
  for (const auto& triangle : piece.triangles)
    for (const int corner : triangle)
      corners.push_back(first + corner);
  places = gathered(places, MPI_DOUBLE, comm);
  corners = gathered(corners, MPI_INT, comm);

  SurfaceSnapshot whole;
  for (std::size_t n = 0; n < places.size(); n += 3)
    whole.points.emplace_back(&places[n]);
  for (std::size_t n = 0; n < corners.size(); n += 3)
    whole.triangles.push_back({corners[n], corners[n + 1], corners[n + 2]});
  for (const NamedField& field : piece.point_fields)
    whole.point_fields.push_back(
        {field.name, field.components, gathered(std::get<std::vector<float>>(field.values), MPI_FLOAT, comm)});
  return whole;
}

}  // namespace luff::output

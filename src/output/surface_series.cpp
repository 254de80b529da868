// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with data by point and by face.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.hpp"
#include "output/series.hpp"
#include "output/vtk_data.hpp"

namespace luff::output {

namespace {

vtkSmartPointer<vtkPoints> vtk_points(const std::vector<Vec3>& positions)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const Vec3& x : positions)
    points->InsertNextPoint(x.data());
  return points;
}

vtkSmartPointer<vtkCellArray> vtk_faces(const SurfaceSnapshot& snapshot)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [a, b, c] : snapshot.triangles)
    cells->InsertNextCell({a, b, c});
  for (const auto& [a, b, c, d] : snapshot.quadrilaterals)
    cells->InsertNextCell({a, b, c, d});
  return cells;
}

vtkSmartPointer<vtkPolyData> vtk_surface(const SurfaceSnapshot& snapshot, double time)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(vtk_points(snapshot.points));
  surface->SetPolys(vtk_faces(snapshot));
  add_fields(*surface->GetPointData(), snapshot.point_fields, snapshot.points.size());
  add_fields(*surface->GetCellData(), snapshot.face_fields, snapshot.triangles.size() + snapshot.quadrilaterals.size());
  set_time(*surface, time);
  return surface;
}

}  // namespace

SurfaceSeries::SurfaceSeries(const RunFolder& folder, std::string name, const EarlierOutput* earlier)
    : folder_(folder), name_(std::move(name)), index_(folder, name_, earlier)
{
}

void SurfaceSeries::write(double time, const SurfaceSnapshot& snapshot)
{
  const std::string file = fmt::format("{}/{}_{:06}.vtp", name_, name_, index_.count());
  if (folder_.writes())
    write_file(file, time, snapshot);
  index_.add(time, file);
}

void SurfaceSeries::write_file(const std::string& file, double time, const SurfaceSnapshot& snapshot) const
{
  std::error_code ignored;  // what matters is whether the file can be written
  std::filesystem::create_directories(folder_.file(name_), ignored);
  const auto surface = vtk_surface(snapshot, time);
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  if (!write_vtk(*writer, *surface, folder_.file(file)))
    fail_run("{}: cannot be written at t = {}; is the disk full, or the folder gone?", folder_.file(file).string(),
             time);
}

}  // namespace luff::output

// SPDX-License-Identifier: BSD-3-Clause
// Vectors that a mesh file keeps for its triangles.
#include "surface/triangle_vectors.hpp"

#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "core/error.hpp"

namespace luff::surface {

namespace {

template <class Reader>
vtkSmartPointer<vtkDataSet> read_data(const std::filesystem::path& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string names_of(vtkCellData& data)
{
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", data.GetArrayName(i));
  return names.empty() ? "none" : names;
}

}  // namespace

std::vector<Vec3> read_triangle_vectors(const std::filesystem::path& file, const std::string& name)
{
  const std::string kind = file.extension();
  if (kind != ".vtp" && kind != ".vtu")
    fail_input("{}: fields are read from .vtp and .vtu files, not '{}'", file.string(), kind);
  const vtkSmartPointer<vtkDataSet> data =
      kind == ".vtp" ? read_data<vtkXMLPolyDataReader>(file) : read_data<vtkXMLUnstructuredGridReader>(file);
  vtkCellData& cells = *data->GetCellData();
  vtkDataArray* array = cells.GetArray(name.c_str());
  if (array == nullptr)
    fail_input("{}: has no array '{}' of its triangles; it has: {}", file.string(), name, names_of(cells));
  if (array->GetNumberOfComponents() != 3)
    fail_input("{}: array '{}' has {} components; a direction has 3", file.string(), name,
               array->GetNumberOfComponents());
  std::vector<Vec3> vectors;
  vectors.reserve(array->GetNumberOfTuples());
  for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t)
    vectors.emplace_back(array->GetTuple3(t));
  return vectors;
}

}  // namespace luff::surface

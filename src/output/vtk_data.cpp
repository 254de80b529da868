// SPDX-License-Identifier: BSD-3-Clause
// Arrays and files of VTK.
#include "output/vtk_data.hpp"

#include <type_traits>

#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include "core/error.hpp"

namespace luff::output {

namespace {

template <class Array, class Number>
vtkSmartPointer<vtkDataArray> referring_array(const std::vector<Number>& numbers)
{
  auto array = vtkSmartPointer<Array>::New();
  // VTK asks for a pointer it could write through; a writer only reads.
  array->SetArray(const_cast<Number*>(numbers.data()), static_cast<vtkIdType>(numbers.size()), /*save=*/1);
  return array;
}

/// VTK reports failures on standard error by itself; we report them, once, in our own words.
class QuietVtk {
 public:
  QuietVtk() { vtkObject::SetGlobalWarningDisplay(0); }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

 private:
  int before_ = vtkObject::GetGlobalWarningDisplay();
};

std::size_t number_count(const NamedField& field)
{
  return std::visit([](const auto& numbers) { return numbers.size(); }, field.values);
}

}  // namespace

vtkSmartPointer<vtkDataArray> vtk_array(const NamedField& field)
{
  vtkSmartPointer<vtkDataArray> array;
  if (const auto* single = std::get_if<std::vector<float>>(&field.values))
    array = referring_array<vtkFloatArray>(*single);
  else
    array = referring_array<vtkDoubleArray>(std::get<std::vector<double>>(field.values));
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(field.components);
  return array;
}

void add_fields(vtkDataSetAttributes& attributes, const std::vector<NamedField>& fields, std::size_t tuples)
{
  for (const NamedField& field : fields) {
    ensure(number_count(field) == tuples * field.components, "a field has its components for every point or cell");
    attributes.AddArray(vtk_array(field));
  }
}

void set_time(vtkDataSet& data, double time)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("TimeValue");
  array->InsertNextValue(time);
  data.GetFieldData()->AddArray(array);
}

bool write_vtk(vtkXMLWriter& writer, vtkDataSet& data, const std::filesystem::path& file)
{
  const QuietVtk quiet;
  writer.SetFileName(file.c_str());
  writer.SetInputDataObject(&data);
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.SetCompressionLevel(1);  // higher levels cost several times as much and save a few per cent of noise
  return writer.Write() == 1 && writer.GetErrorCode() == vtkErrorCode::NoError;
}

std::string vtk_type(const NamedField& field)
{
  return std::holds_alternative<std::vector<float>>(field.values) ? "Float32" : "Float64";
}

}  // namespace luff::output

// SPDX-License-Identifier: BSD-3-Clause
// Triangles, sets and fields of vectors from the files that VTK reads.
#include "surface/vtk_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "core/error.hpp"
#include "surface/validation.hpp"
#include "vtk/reading.hpp"

namespace luff::surface {

namespace {

using File = std::filesystem::path;

/// A reader that knows of an empty PointData in pieces that have none: VTK names that element when it complains about
/// an array of CellData that is too short, whether it is there or not.
template <class Reader>
class WithPointData : public Reader {
 public:
  static WithPointData* New()
  {
    auto* reader = new WithPointData;
    reader->InitializeObjectBase();
    return reader;
  }

 protected:
  int ReadPiece(vtkXMLDataElement* piece) override
  {
    const int read = Reader::ReadPiece(piece);
    if (read != 0 && this->PointDataElements[this->Piece] == nullptr)
      this->PointDataElements[this->Piece] = none_;
    return read;
  }

 private:
  vtkNew<vtkXMLDataElement> none_;
};

template <class Reader>
auto read(Reader& reader, const File& file, const std::string& kind)
{
  vtk::read(reader, file, kind.substr(1), [](Reader& r) { r.Update(); });
  vtkSmartPointer data = reader.GetOutput();
  if (!data || data->GetNumberOfPoints() == 0)
    fail_input("{}: holds no surface that can be read as {}; is it another kind of file?", file.string(),
               kind.substr(1));
  return data;
}

void add_triangles(vtkCellArray& cells, const File& file, TriangleMesh& mesh)
{
  if (!cells.IsValid())
    fail_input("{}: its polygons' offsets don't fit their corners; write the file again", file.string());
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < cells.GetNumberOfCells(); ++t) {
    cells.GetCellAtId(t, corners);
    if (corners->GetNumberOfIds() != 3)
      fail_input("{}: polygon {} has {} corners; cut it into triangles (ParaView: Triangulate)", file.string(), t,
                 corners->GetNumberOfIds());
    mesh.triangles.push_back({static_cast<int>(corners->GetId(0)), static_cast<int>(corners->GetId(1)),
                              static_cast<int>(corners->GetId(2))});
  }
}

TriangleMesh triangles(vtkPolyData& data, const File& file)
{
  if (data.GetNumberOfStrips() + data.GetNumberOfLines() + data.GetNumberOfVerts() > 0)
    fail_input("{}: holds {} strips, {} lines and {} points besides polygons; keep only triangles", file.string(),
               data.GetNumberOfStrips(), data.GetNumberOfLines(), data.GetNumberOfVerts());
  TriangleMesh mesh;
  add_triangles(*data.GetPolys(), file, mesh);
  return mesh;
}

TriangleMesh triangles(vtkUnstructuredGrid& data, const File& file)
{
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c)
    if (data.GetCellType(c) != VTK_TRIANGLE)
      fail_input(
          "{}: cell {} is of VTK's type {}, not a triangle (type {}); extract the surface and keep only triangles",
          file.string(), c, data.GetCellType(c), int(VTK_TRIANGLE));
  TriangleMesh mesh;
  if (data.GetNumberOfCells() > 0)
    add_triangles(*data.GetCells(), file, mesh);
  return mesh;
}

std::vector<int> not_zero(vtkDataArray& array)
{
  std::vector<int> members;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    if (array.GetComponent(i, 0) != 0)
      members.push_back(static_cast<int>(i));
  return members;
}

std::vector<Vec3> vectors(vtkDataArray& array)
{
  std::vector<Vec3> result;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    result.emplace_back(array.GetTuple3(i));
  return result;
}

std::vector<Vec3> averaged_over_corners(const std::vector<Vec3>& at_points, const TriangleMesh& mesh)
{
  std::vector<Vec3> result;
  for (const auto& [i, j, k] : mesh.triangles)
    result.push_back((at_points[i] + at_points[j] + at_points[k]) / 3);
  return result;
}

/// Calls `visit(name, array)` for the arrays with a name and as many numbers as there should be.
void for_each_array(vtkDataSetAttributes& attributes, std::size_t tuples, const auto& visit)
{
  for (int a = 0; a < attributes.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = attributes.GetArray(a);  // none for text
    if (array && array->GetName() && array->GetNumberOfTuples() == static_cast<vtkIdType>(tuples))
      visit(std::string(array->GetName()), *array);
  }
}

void add_marks(vtkDataSet& data, MarkedMesh& marked)
{
  Marks& marks = marked.marks;
  for_each_array(*data.GetPointData(), marked.mesh.vertices.size(), [&](const std::string& name, vtkDataArray& array) {
    if (array.GetNumberOfComponents() == 1)
      marks.sets.vertices[name] = not_zero(array);
    else if (array.GetNumberOfComponents() == 3)
      marks.directions[name] = averaged_over_corners(vectors(array), marked.mesh);
  });
  for_each_array(*data.GetCellData(), marked.mesh.triangles.size(), [&](const std::string& name, vtkDataArray& array) {
    if (array.GetNumberOfComponents() == 1)
      marks.sets.triangles[name] = not_zero(array);
    else if (array.GetNumberOfComponents() == 3)
      marks.directions[name] = vectors(array);
  });
}

/// As VTK's readers have it: of the first 256 bytes one in twenty is no letter.
bool is_binary(std::string_view start)
{
  const auto is_text = [](unsigned char byte) {
    return (byte >= 0x20 && byte <= 0x7f) || byte == '\n' || byte == '\r' || byte == '\t';
  };
  const auto letters = std::count_if(start.begin(), start.end(), is_text);
  return 20 * (static_cast<std::ptrdiff_t>(start.size()) - letters) >= static_cast<std::ptrdiff_t>(start.size());
}

/// VTK makes room for as many triangles as a binary STL says that it has: 80 bytes of any text, their number, and 50
/// bytes for each.
void refuse_stl_cut_short(const File& file)
{
  constexpr std::size_t head = 84;
  std::string start(256, ' ');
  std::ifstream in(file, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  if (start.size() < head || !is_binary(start))
    return;
  std::uint32_t count = 0;
  std::memcpy(&count, start.data() + 80, sizeof count);
  const std::uintmax_t needed = head + 50 * std::uintmax_t{count};
  if (const std::uintmax_t size = std::filesystem::file_size(file); size < needed)
    fail_input(
        "{}: a binary STL of {} triangles has {} bytes, this one {}: it is cut short, or text with other bytes in it",
        file.string(), count, needed, size);
}

template <class Reader>
MarkedMesh read_as(const File& file, const std::string& kind)
{
  vtkNew<Reader> reader;
  if constexpr (std::is_same_v<Reader, vtkSTLReader>)
    reader->MergingOff();
  const auto data = read(*reader, file, kind);
  MarkedMesh marked{.mesh = triangles(*data, file)};
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
    marked.mesh.vertices.emplace_back(data->GetPoint(v));
  validate_numbers(marked.mesh, file.string());
  if (kind == ".vtp" || kind == ".vtu")
    add_marks(*data, marked);
  return marked;
}

}  // namespace

MarkedMesh read_vtk(const std::filesystem::path& file, const std::string& kind)
{
  if (kind == ".stl") {
    refuse_stl_cut_short(file);
    return read_as<vtkSTLReader>(file, kind);
  }
  if (kind == ".vtu")
    return read_as<WithPointData<vtkXMLUnstructuredGridReader>>(file, kind);
  return read_as<WithPointData<vtkXMLPolyDataReader>>(file, kind);
}

}  // namespace luff::surface

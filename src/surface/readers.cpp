// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes from files.
#include "surface/readers.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include "core/error.hpp"
#include "surface/ply_check.hpp"
#include "surface/validation.hpp"

namespace luff::surface {

namespace {

/// Collects what VTK would print.
class Transcript : public vtkOutputWindow {
 public:
  static Transcript* New();
  void DisplayText(const char* text) override { text_ += text; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};
vtkStandardNewMacro(Transcript)

    /// Puts a transcript in the place of VTK's output window and log for as long as it lives.
    class Listening {
 public:
  Listening() : before_(vtkOutputWindow::GetInstance()), verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff())
  {
    vtkOutputWindow::SetInstance(transcript_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Listening()
  {
    vtkOutputWindow::SetInstance(before_);
    vtkLogger::SetStderrVerbosity(verbosity_before_);
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  const std::string& heard() const { return transcript_->text(); }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_before_;
  vtkNew<Transcript> transcript_;
};

std::string ending(const std::filesystem::path& file)
{
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void check_readable(const std::filesystem::path& file)
{
  if (!std::filesystem::exists(file))
    fail_input("{}: there is no such file; paths are relative to the case file", file.string());
  if (!std::filesystem::is_regular_file(file))
    fail_input("{}: is not a file", file.string());
  if (!std::ifstream(file).good())
    fail_input("{}: may not be read; check its permissions", file.string());
  if (std::filesystem::file_size(file) == 0)
    fail_input("{}: is empty", file.string());
}

/// One line of VTK's complaint, without its addresses.
std::string complaint(const std::string& heard)
{
  std::string text = heard.substr(heard.rfind("): ") == std::string::npos ? 0 : heard.rfind("): ") + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

template <class Reader>
vtkSmartPointer<vtkPolyData> read(Reader& reader, const std::filesystem::path& file)
{
  const Listening listening;
  reader.SetFileName(file.c_str());
  reader.Update();
  if (!listening.heard().empty())
    fail_input("{}: cannot be read as {}: {}; write the file again", file.string(), ending(file).substr(1),
               complaint(listening.heard()));
  vtkSmartPointer<vtkPolyData> data = reader.GetOutput();
  if (!data || data->GetNumberOfPoints() == 0)
    fail_input("{}: holds no surface that can be read as {}; is it another kind of file?", file.string(),
               ending(file).substr(1));
  return data;
}

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file)
{
  const std::string kind = ending(file);
  if (kind == ".stl") {
    vtkNew<vtkSTLReader> reader;
    reader->MergingOff();
    return read(*reader, file);
  }
  if (kind == ".obj") {
    vtkNew<vtkOBJReader> reader;
    return read(*reader, file);
  }
  if (kind == ".ply") {
    check_ply_is_complete(file);
    vtkNew<vtkPLYReader> reader;
    return read(*reader, file);
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  return read(*reader, file);
}

TriangleMesh triangles(vtkPolyData& data, const std::filesystem::path& file)
{
  if (data.GetNumberOfStrips() + data.GetNumberOfLines() + data.GetNumberOfVerts() > 0)
    fail_input("{}: holds {} strips, {} lines and {} points besides polygons; keep only triangles", file.string(),
               data.GetNumberOfStrips(), data.GetNumberOfLines(), data.GetNumberOfVerts());
  if (!data.GetPolys()->IsValid())
    fail_input("{}: its polygons' offsets don't fit their corners; write the file again", file.string());
  TriangleMesh mesh;
  for (vtkIdType v = 0; v < data.GetNumberOfPoints(); ++v)
    mesh.vertices.emplace_back(data.GetPoint(v));
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < data.GetNumberOfPolys(); ++t) {
    data.GetPolys()->GetCellAtId(t, corners);
    if (corners->GetNumberOfIds() != 3)
      fail_input("{}: polygon {} has {} corners; cut it into triangles (ParaView: Triangulate)", file.string(), t,
                 corners->GetNumberOfIds());
    mesh.triangles.push_back({static_cast<int>(corners->GetId(0)), static_cast<int>(corners->GetId(1)),
                              static_cast<int>(corners->GetId(2))});
  }
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file)
{
  const std::string kind = ending(file);
  if (kind != ".stl" && kind != ".obj" && kind != ".ply" && kind != ".vtp")
    fail_input("{}: meshes are read from .stl, .obj, .ply and .vtp files, not '{}'", file.string(), kind);
  check_readable(file);
  TriangleMesh mesh = triangles(*read(file), file);
  validate_numbers(mesh, file.string());
  if (kind == ".stl")
    mesh = merge_vertices(mesh, stl_merge_tolerance);
  else if (kind == ".obj")
    mesh = merge_vertices(mesh, duplicate_tolerance);
  validate(mesh, file.string());
  return mesh;
}

}  // namespace luff::surface

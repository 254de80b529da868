// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes from files.
#include "surface/readers.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/error.hpp"
#include "core/readable.hpp"
#include "surface/gmsh_reader.hpp"
#include "surface/obj_reader.hpp"
#include "surface/ply_reader.hpp"
#include "surface/repair.hpp"
#include "surface/validation.hpp"
#include "surface/vtk_reader.hpp"

namespace luff::surface {

namespace {

std::string ending(const std::filesystem::path& file)
{
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool is_known(const std::string& kind)
{
  for (const char* known : {".stl", ".obj", ".ply", ".vtp", ".vtu", ".msh"})
    if (kind == known)
      return true;
  return false;
}

MarkedMesh read_unchecked(const std::filesystem::path& file, const std::string& kind)
{
  if (kind == ".msh")
    return read_gmsh(file);
  if (kind == ".obj")
    return read_obj(file);
  if (kind == ".ply")
    return {.mesh = read_ply(file)};
  return read_vtk(file, kind);
}

}  // namespace

MarkedMesh read_mesh(const std::filesystem::path& file, Repair repairing)
{
  const std::string kind = ending(file);
  if (!is_known(kind))
    fail_input("{}: meshes are read from {} files, not '{}'", file.string(), mesh_file_endings, kind);
  require_readable(file);
  MarkedMesh marked = read_unchecked(file, kind);
  validate_numbers(marked.mesh, file.string());
  if (kind == ".stl")  // has separate corners, which is no fault of the file
    unite_vertices(marked, stl_merge_tolerance);
  if (repairing == Repair::Yes)
    repair(marked);
  validate(marked.mesh, file.string());
  return marked;
}

}  // namespace luff::surface

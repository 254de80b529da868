// SPDX-License-Identifier: BSD-3-Clause
// Choosing vertices of a surface by where they are.
#include "surface/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "core/nearest.hpp"

namespace luff::surface {

namespace {

std::string text(const Vec3& p)
{
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

double distance(const EdgeWhere& edge, const Vec3& x)
{
  const Vec3 along = edge.q - edge.p;
  const double s = std::clamp(along.dot(x - edge.p) / along.squaredNorm(), 0.0, 1.0);
  return (x - edge.p - s * along).norm();
}

double distance(const BoxWhere& box, const Vec3& x)
{
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

double distance(const PlaneWhere& plane, const Vec3& x)
{
  return std::abs(plane.normal.normalized().dot(x - plane.point));
}

double distance(const PointWhere& point, const Vec3& x)
{
  return (x - point.point).norm();
}

void check(const EdgeWhere& edge, std::string_view what)
{
  if (!((edge.q - edge.p).norm() > 0))
    fail_input("{}: edge = [{}, {}] has no length; give its two ends", what, text(edge.p), text(edge.q));
}

void check(const BoxWhere& box, std::string_view what)
{
  if (!((box.high - box.low).minCoeff() >= 0))
    fail_input("{}: box = [{}, {}] must have its low corner first", what, text(box.low), text(box.high));
}

void check(const PlaneWhere& plane, std::string_view what)
{
  if (!(plane.normal.norm() > 0))
    fail_input("{}: the plane's normal {} must have a length", what, text(plane.normal));
}

void check(const PointWhere& point, std::string_view what)
{
  if (!point.point.allFinite())
    fail_input("{}: point = {} must be finite", what, text(point.point));
}

std::vector<int> vertices_at(const TriangleMesh& mesh, const auto& where, std::string_view what)
{
  check(where, what);
  const double slack = selection_tolerance * bounding_box(mesh.vertices).size();
  std::vector<int> found;
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    const double d = distance(where, mesh.vertices[v]);
    if (d <= slack)
      found.push_back(v);
    if (d < least) {
      least = d;
      nearest = v;
    }
  }
  if (found.empty())
    fail_input(
        "{}: no vertex lies there (in the reference configuration, after rotate, translate and scale); the nearest "
        "is vertex {} at {}, {:.3g} away",
        what, nearest, text(mesh.vertices[nearest]), least);
  return found;
}

int nearest_vertex(const TriangleMesh& mesh, const PointWhere& where)
{
  int nearest = 0;
  for (int v = 1; v < mesh.n_vertices(); ++v)
    if (distance(where, mesh.vertices[v]) < distance(where, mesh.vertices[nearest]))
      nearest = v;
  return nearest;
}

/// The set's vertices and those of its edges and triangles.
std::vector<int> vertices_of(const TriangleMesh& mesh, const std::string& name, const Sets& sets)
{
  std::vector<int> found;
  if (const auto set = sets.vertices.find(name); set != sets.vertices.end())
    found = set->second;
  if (const auto set = sets.edges.find(name); set != sets.edges.end())
    for (const auto& [a, b] : set->second)
      found.insert(found.end(), {a, b});
  if (const auto set = sets.triangles.find(name); set != sets.triangles.end())
    for (const int t : set->second)
      found.insert(found.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void check_name(const std::string& name, std::string_view what, const Sets& sets)
{
  const std::vector<std::string> known = names(sets);
  if (known.empty())
    fail_input(
        "{}: set = \"{}\": the mesh has no named sets; made meshes and VTP, VTU, OBJ and Gmsh files may have them",
        what, name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    fail_input("{}: the mesh has no set \"{}\"{}", what, name, suggestion(name, known));
}

struct VertexSelector {
  const TriangleMesh& mesh;
  std::string_view what;
  const Sets& sets;

  std::vector<int> operator()(const AllWhere&) const
  {
    std::vector<int> all(mesh.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  std::vector<int> operator()(const PointWhere& where) const
  {
    check(where, what);
    return {nearest_vertex(mesh, where)};
  }

  std::vector<int> operator()(const SetWhere& where) const
  {
    check_name(where.name, what, sets);
    const std::vector<int> found = vertices_of(mesh, where.name, sets);
    if (found.empty())
      fail_input("{}: the mesh's set \"{}\" is empty", what, where.name);
    return found;
  }

  std::vector<int> operator()(const auto& where) const { return vertices_at(mesh, where, what); }
};

}  // namespace

std::vector<int> select_vertices(const TriangleMesh& mesh, const Where& where, std::string_view what, const Sets& sets)
{
  ensure(!mesh.vertices.empty(), "selection from an empty mesh");
  return std::visit(VertexSelector{mesh, what, sets}, where);
}

std::vector<int> select_triangles(const TriangleMesh& mesh, const Where& where, std::string_view what, const Sets& sets)
{
  const std::vector<int> vertices = select_vertices(mesh, where, what, sets);
  if (const auto* named = std::get_if<SetWhere>(&where))
    if (const auto set = sets.triangles.find(named->name); set != sets.triangles.end() && !set->second.empty())
      return set->second;
  std::vector<char> chosen(mesh.vertices.size(), 0);
  for (const int v : vertices)
    chosen[v] = 1;
  std::vector<int> found;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (const auto& [i, j, k] = mesh.triangles[t]; chosen[i] && chosen[j] && chosen[k])
      found.push_back(t);
  if (found.empty())
    fail_input("{}: no triangle lies wholly in the selection; select more, or load vertices or edges", what);
  return found;
}

}  // namespace luff::surface

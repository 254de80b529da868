// SPDX-License-Identifier: BSD-3-Clause
// Duplicates united, orphans dropped, triangles turned.
#include "surface/repair.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/core.h>

#include "core/bounding_box.hpp"
#include "surface/orientation.hpp"
#include "surface/point_index.hpp"
#include "surface/validation.hpp"

namespace luff::surface {

namespace {

/// New number of each vertex or triangle, -1 for those that are dropped.
using Renumbering = std::vector<int>;

void renumber(std::map<std::string, std::vector<int>>& sets, const Renumbering& number)
{
  for (auto& [name, members] : sets) {
    for (int& member : members)
      member = number[member];
    std::erase(members, -1);
  }
}

void renumber_vertices(MarkedMesh& marked, const Renumbering& number)
{
  for (auto& triangle : marked.mesh.triangles)
    for (int& v : triangle)
      v = number[v];
  renumber(marked.marks.sets.vertices, number);
  for (auto& [name, edges] : marked.marks.sets.edges) {
    for (EdgeKey& edge : edges)
      edge = edge_key(number[edge.first], number[edge.second]);
    std::erase_if(edges, [](const EdgeKey& e) { return e.first < 0 || e.first == e.second; });
  }
}

int drop_unused_vertices(MarkedMesh& marked)
{
  std::vector<Vec3>& x = marked.mesh.vertices;
  Renumbering number(x.size(), -1);
  for (const auto& triangle : marked.mesh.triangles)
    for (const int v : triangle)
      number[v] = 0;
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<int>(kept.size());
      kept.push_back(x[v]);
    }
  const int dropped = static_cast<int>(x.size() - kept.size());
  x = std::move(kept);
  renumber_vertices(marked, number);
  return dropped;
}

int drop_repeated_triangles(MarkedMesh& marked)
{
  std::vector<std::array<int, 3>>& triangles = marked.mesh.triangles;
  std::map<std::array<int, 3>, int> seen;
  std::vector<std::array<int, 3>> kept;
  std::vector<int> origin;
  Renumbering number;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<int, 3> key = triangles[t];
    std::sort(key.begin(), key.end());
    const auto [place, is_new] = seen.emplace(key, static_cast<int>(kept.size()));
    number.push_back(place->second);
    if (is_new) {
      kept.push_back(triangles[t]);
      origin.push_back(static_cast<int>(t));
    }
  }
  const int dropped = static_cast<int>(triangles.size() - kept.size());
  triangles = std::move(kept);
  renumber(marked.marks.sets.triangles, number);
  for (auto& [name, field] : marked.marks.directions) {
    std::vector<Vec3> remaining;
    for (const int t : origin)
      remaining.push_back(field[t]);
    field = std::move(remaining);
  }
  return dropped;
}

int turn_triangles(TriangleMesh& mesh)
{
  const Orientation found = orientation(mesh);
  if (found.one_sided >= 0)
    return 0;
  for (const int t : found.flipped)
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return static_cast<int>(found.flipped.size());
}

void add(std::string& list, int count, const char* one, const char* many, const char* what)
{
  if (count > 0)
    list += fmt::format("{}{} {} {}", list.empty() ? "" : ", ", count, count == 1 ? one : many, what);
}

}  // namespace

std::string text(const Repairs& repairs)
{
  std::string list;
  add(list, repairs.united_vertices, "vertex", "vertices", "united with another at the same place");
  add(list, repairs.dropped_vertices, "vertex", "vertices", "without triangle dropped");
  add(list, repairs.dropped_triangles, "triangle", "triangles", "with the corners of another dropped");
  add(list, repairs.reversed_triangles, "triangle", "triangles", "reversed to face as the neighbours do");
  return list.empty() ? "nothing" : list;
}

int unite_vertices(MarkedMesh& marked, double tolerance)
{
  std::vector<Vec3>& x = marked.mesh.vertices;
  const BoundingBox box = bounding_box(x);
  PointIndex placed(box.low, tolerance * box.size());
  Renumbering number;
  std::vector<Vec3> kept;
  for (const Vec3& p : x) {
    int v = placed.find(p);
    if (v < 0) {
      v = static_cast<int>(kept.size());
      placed.add(v, p);
      kept.push_back(p);
    }
    number.push_back(v);
  }
  const int united = static_cast<int>(x.size() - kept.size());
  x = std::move(kept);
  renumber_vertices(marked, number);
  return united;
}

void repair(MarkedMesh& marked)
{
  Repairs& repairs = marked.marks.repairs;
  repairs.united_vertices = unite_vertices(marked, duplicate_tolerance);
  repairs.dropped_vertices = drop_unused_vertices(marked);
  repairs.dropped_triangles = drop_repeated_triangles(marked);
  repairs.reversed_triangles = turn_triangles(marked.mesh);
  tidy(marked.marks.sets);
}

}  // namespace luff::surface

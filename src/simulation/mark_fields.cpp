// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mark_fields.hpp"

namespace luff::simulation {

namespace {

output::NamedField ones_at(const std::string& name, const std::vector<int>& members, int size)
{
  std::vector<float> values(size, 0.0F);
  for (const int member : members)
    values[member] = 1.0F;
  return {name, 1, std::move(values)};
}

/// Sets of vertices, and the ends of sets of edges.
std::map<std::string, std::vector<int>> sets_at_vertices(const surface::Sets& sets)
{
  std::map<std::string, std::vector<int>> all = sets.vertices;
  for (const auto& [name, edges] : sets.edges)
    for (const auto& [a, b] : edges)
      all[name].insert(all[name].end(), {a, b});
  return all;
}

}  // namespace

void add_marks(const SheetRange& sheet, output::SurfaceSnapshot& snapshot)
{
  for (const auto& [name, members] : sets_at_vertices(sheet.marks.sets))
    snapshot.point_fields.push_back(ones_at(name, members, sheet.vertices));
  for (const auto& [name, members] : sheet.marks.sets.triangles)
    snapshot.face_fields.push_back(ones_at(name, members, sheet.triangles));
  for (const auto& [name, directions] : sheet.marks.directions) {
    std::vector<double> values;
    for (const Vec3& direction : directions)
      values.insert(values.end(), direction.begin(), direction.end());
    snapshot.face_fields.push_back({name, 3, std::move(values)});
  }
}

}  // namespace luff::simulation

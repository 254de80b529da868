// SPDX-License-Identifier: BSD-3-Clause
// Names of the parts of a mesh.
#include "surface/marked_mesh.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/nearest.hpp"

namespace luff::surface {

std::vector<std::string> names(const Sets& sets)
{
  std::set<std::string> all;
  const auto add = [&](const auto& named) {
    for (const auto& [name, numbers] : named)
      all.insert(name);
  };
  add(sets.vertices);
  add(sets.edges);
  add(sets.triangles);
  return {all.begin(), all.end()};
}

void tidy(Sets& sets)
{
  const auto tidy_all = [](auto& named) {
    for (auto& [name, numbers] : named) {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }
  };
  tidy_all(sets.vertices);
  tidy_all(sets.edges);
  tidy_all(sets.triangles);
}

const std::vector<Vec3>& direction_field(const Marks& marks, const std::string& name, std::string_view what)
{
  const auto found = marks.directions.find(name);
  if (found != marks.directions.end())
    return found->second;
  std::vector<std::string> known;
  for (const auto& [field, values] : marks.directions)
    known.push_back(field);
  if (known.empty())
    fail_input("{}: the mesh has no fields of vectors, so no '{}'; only VTP and VTU files hold them", what, name);
  fail_input("{}: the mesh has no field of vectors '{}'{}", what, name, suggestion(name, known));
}

}  // namespace luff::surface

// SPDX-License-Identifier: BSD-3-Clause
// Triangles and groups from Wavefront's OBJ files.
#include "surface/obj_reader.hpp"

#include <sstream>
#include <string>

#include "core/error.hpp"
#include "surface/file_text.hpp"

namespace luff::surface {

namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : file_(file.string()), lines_(contents(file)) {}

  MarkedMesh read()
  {
    std::string line;
    while (std::getline(lines_, line)) {
      ++line_;
      std::istringstream words(line.substr(0, line.find('#')));
      std::string keyword;
      words >> keyword;
      if (keyword == "v")
        read_vertex(words);
      else if (keyword == "f")
        read_face(words);
      else if (keyword == "g")
        read_groups(words);
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const
  {
    fail_input("{}:{}: cannot be read as obj: {}", file_, line_, why);
  }

  void read_vertex(std::istringstream& words)
  {
    Vec3 x;
    for (double& coordinate : x) {
      std::string word;
      words >> word;
      const auto value = number<double>(word);
      if (!value)
        refuse(fmt::format("'{:.40}' must be a coordinate; a vertex has three", word));
      coordinate = *value;
    }
    result_.mesh.vertices.push_back(x);
  }

  void read_face(std::istringstream& words)
  {
    std::vector<int> corners;
    std::string word;
    while (words >> word)
      corners.push_back(corner(word));
    if (corners.size() != 3)
      refuse(fmt::format("polygon {} has {} corners; cut it into triangles (ParaView: Triangulate)",
                         result_.mesh.n_triangles(), corners.size()));
    for (const std::string& group : groups_)
      result_.marks.sets.triangles[group].push_back(result_.mesh.n_triangles());
    result_.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }

  /// "7", "7/1", "7/1/2" or "7//2"; from 1, or back from the last vertex if negative.
  int corner(const std::string& word) const
  {
    const auto value = number<long>(word.substr(0, word.find('/')));
    const long n = result_.mesh.n_vertices();
    if (!value || *value == 0 || *value > n || *value < -n)
      refuse(fmt::format("'{:.40}' must be the number of one of the {} vertices before it", word, n));
    return static_cast<int>(*value > 0 ? *value - 1 : n + *value);
  }

  void read_groups(std::istringstream& words)
  {
    groups_.clear();
    std::string name;
    while (words >> name)
      groups_.push_back(name);
  }

  std::string file_;
  std::istringstream lines_;
  long line_ = 0;
  std::vector<std::string> groups_;  ///< that the next faces belong to
  MarkedMesh result_;
};

}  // namespace

MarkedMesh read_obj(const std::filesystem::path& file)
{
  return ObjReader(file).read();
}

}  // namespace luff::surface

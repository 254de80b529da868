// SPDX-License-Identifier: BSD-3-Clause
// Triangles and physical groups from Gmsh's files.
#include "surface/gmsh_reader.hpp"

#include <cstdlib>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "surface/gmsh_source.hpp"

namespace luff::surface {

namespace {

/// Dimension and number.
using Tag = std::pair<int, long>;

struct ElementType {
  long number;
  int dimension;
  int corners;
};

class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& file) : source_(file) {}

  MarkedMesh read()
  {
    read_format();
    while (!source_.at_end())
      read_section();
    if (result_.mesh.vertices.empty())
      source_.refuse("it holds no nodes");
    tidy(result_.marks.sets);
    return std::move(result_);
  }

 private:
  enum class Version { Two, Four };

  void read_format()
  {
    if (source_.word() != "$MeshFormat")
      source_.refuse("it doesn't start with $MeshFormat");
    const std::string version = source_.word();
    if (version != "2.2" && version != "4.1")
      source_.refuse(fmt::format("format {:.20} is not known; save it as 4.1 or 2.2", version));
    version_ = version == "2.2" ? Version::Two : Version::Four;
    const bool binary = source_.text_integer() != 0;
    if (source_.text_integer() != 8)
      source_.refuse("its numbers must have 8 bytes");
    if (binary) {
      source_.skip_line_end();
      source_.set_binary(true);
      if (source_.integer() != 1)
        source_.refuse("its bytes are in another order than this machine's");
    }
    end_section("$EndMeshFormat");
  }

  void read_section()
  {
    const std::string name = source_.word();
    if (name.size() < 2 || name.front() != '$')
      source_.refuse(fmt::format("'{:.40}' stands where a section must begin", name));
    if (name == "$PhysicalNames")
      return read_names();
    const bool four = version_ == Version::Four;
    if (name == "$Entities" && four)
      return in_section(name, &GmshReader::read_entities);
    if (name == "$Nodes")
      return in_section(name, four ? &GmshReader::read_node_blocks : &GmshReader::read_nodes);
    if (name == "$Elements")
      return in_section(name, four ? &GmshReader::read_element_blocks
                                   : (source_.binary() ? &GmshReader::read_element_runs : &GmshReader::read_elements));
    source_.skip_past("$End" + name.substr(1));
  }

  void in_section(const std::string& name, void (GmshReader::*read_it)())
  {
    if (source_.binary())
      source_.skip_line_end();
    (this->*read_it)();
    end_section("$End" + name.substr(1));
  }

  void end_section(const std::string& end)
  {
    if (const std::string word = source_.word(); word != end)
      source_.refuse(fmt::format("'{:.40}' stands where {} must", word, end));
  }

  void read_names()
  {
    for (long n = source_.text_integer(); n > 0; --n) {
      const int dimension = static_cast<int>(source_.text_integer());
      const long number = source_.text_integer();
      names_[{dimension, number}] = source_.quoted();
    }
    end_section("$EndPhysicalNames");
  }

  /// Points, curves, surfaces, volumes: only their physical groups are of interest.
  void read_entities()
  {
    long counts[4];
    for (long& count : counts)
      count = source_.count();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long n = 0; n < counts[dimension]; ++n) {
        const long number = source_.integer();
        for (int box = dimension == 0 ? 3 : 6; box > 0; --box)
          source_.real();
        std::vector<long>& groups = groups_[{dimension, number}];
        for (long group = source_.count(); group > 0; --group)
          groups.push_back(source_.integer());
        for (long boundary = dimension == 0 ? 0 : source_.count(); boundary > 0; --boundary)
          source_.integer();
      }
  }

  void read_node_blocks()
  {
    const long blocks = source_.count();
    skip_sizes(3);
    for (long block = 0; block < blocks; ++block) {
      const long dimension = source_.integer();
      source_.integer();
      const bool parametric = source_.integer() != 0;
      const long n = source_.count();
      const std::size_t first = result_.mesh.vertices.size();
      for (long i = 0; i < n; ++i)
        number_node(source_.size(), first + i);
      for (long i = 0; i < n; ++i) {
        read_point();
        for (long parameter = parametric ? dimension : 0; parameter > 0; --parameter)
          source_.real();
      }
    }
  }

  void read_nodes()
  {
    for (long n = count_of_items(); n > 0; --n) {
      number_node(source_.integer(), result_.mesh.vertices.size());
      read_point();
    }
  }

  void read_element_blocks()
  {
    const long blocks = source_.count();
    skip_sizes(3);
    for (long block = 0; block < blocks; ++block) {
      const int dimension = static_cast<int>(source_.integer());
      const long entity = source_.integer();
      const ElementType type = known_type(source_.integer());
      const std::vector<long>& groups = groups_[{dimension, entity}];
      for (long n = source_.count(); n > 0; --n) {
        source_.size();
        long corners[3] = {};
        for (int c = 0; c < type.corners; ++c)
          corners[c] = source_.size();
        add_element(type, corners, groups);
      }
    }
  }

  void read_elements()
  {
    for (long n = count_of_items(); n > 0; --n) {
      source_.integer();
      const ElementType type = known_type(source_.integer());
      read_tagged(type, source_.integer_count());
    }
  }

  /// Binary 2.2: runs of elements of one type.
  void read_element_runs()
  {
    for (long remaining = count_of_items(); remaining > 0;) {
      const ElementType type = known_type(source_.integer());
      const long run = source_.integer_count();
      const long tags = source_.integer_count();
      if (run < 1 || run > remaining)
        source_.refuse(fmt::format("a run of {} elements is not among the {} that remain", run, remaining));
      remaining -= run;
      for (long n = 0; n < run; ++n) {
        source_.integer();
        read_tagged(type, tags);
      }
    }
  }

  /// The first tag is the physical group, 0 if there is none.
  void read_tagged(const ElementType& type, long tags)
  {
    std::vector<long> groups;
    for (long tag = 0; tag < tags; ++tag)
      if (const long number = source_.integer(); tag == 0 && number != 0)
        groups.push_back(number);
    long corners[3] = {};
    for (int c = 0; c < type.corners; ++c)
      corners[c] = source_.integer();
    add_element(type, corners, groups);
  }

  /// Format 2.2 writes it as a line of text, in binary files, too.
  long count_of_items()
  {
    const long n = source_.text_count();
    if (source_.binary())
      source_.skip_line_end();
    return n;
  }

  void skip_sizes(int n)
  {
    for (; n > 0; --n)
      source_.size();
  }

  void number_node(long number, std::size_t vertex)
  {
    if (vertex >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
      source_.refuse("it has more nodes than can be numbered");
    if (!vertex_of_.emplace(number, static_cast<int>(vertex)).second)
      source_.refuse(fmt::format("node {} is defined twice", number));
  }

  void read_point()
  {
    const double x = source_.real(), y = source_.real(), z = source_.real();
    result_.mesh.vertices.emplace_back(x, y, z);
  }

  ElementType known_type(long number)
  {
    for (const ElementType& type : {ElementType{15, 0, 1}, ElementType{1, 1, 2}, ElementType{2, 2, 3}})
      if (type.number == number)
        return type;
    source_.refuse(
        fmt::format("elements of type {} are no points (15), lines (1) or triangles (2) of first order; mesh "
                    "surfaces alone, by triangles",
                    number));
  }

  void add_element(const ElementType& type, const long (&nodes)[3], const std::vector<long>& groups)
  {
    std::array<int, 3> v{};
    for (int c = 0; c < type.corners; ++c) {
      const auto found = vertex_of_.find(nodes[c]);
      if (found == vertex_of_.end())
        source_.refuse(fmt::format("an element uses node {}, which is not defined", nodes[c]));
      v[c] = found->second;
    }
    if (type.dimension == 2)
      result_.mesh.triangles.push_back(v);
    for (const long group : groups) {
      const std::string name = name_of({type.dimension, std::labs(group)});
      Sets& sets = result_.marks.sets;
      if (type.dimension == 0)
        sets.vertices[name].push_back(v[0]);
      else if (type.dimension == 1)
        sets.edges[name].push_back(edge_key(v[0], v[1]));
      else
        sets.triangles[name].push_back(result_.mesh.n_triangles() - 1);
    }
  }

  std::string name_of(const Tag& group) const
  {
    const auto found = names_.find(group);
    return found == names_.end() ? std::to_string(group.second) : found->second;
  }

  GmshSource source_;
  Version version_ = Version::Four;
  std::map<Tag, std::string> names_;         ///< of physical groups
  std::map<Tag, std::vector<long>> groups_;  ///< of each entity
  std::unordered_map<long, int> vertex_of_;  ///< by the file's number of the node
  MarkedMesh result_;
};

}  // namespace

MarkedMesh read_gmsh(const std::filesystem::path& file)
{
  return GmshReader(file).read();
}

}  // namespace luff::surface

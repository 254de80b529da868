// SPDX-License-Identifier: BSD-3-Clause
// Triangles from PLY files.
#include "surface/ply_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "surface/file_text.hpp"

namespace luff::surface {

namespace {

enum class NumberType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

const std::map<std::string, NumberType> number_types{
    {"char", NumberType::Int8},      {"int8", NumberType::Int8},       {"uchar", NumberType::Uint8},
    {"uint8", NumberType::Uint8},    {"short", NumberType::Int16},     {"int16", NumberType::Int16},
    {"ushort", NumberType::Uint16},  {"uint16", NumberType::Uint16},   {"int", NumberType::Int32},
    {"int32", NumberType::Int32},    {"uint", NumberType::Uint32},     {"uint32", NumberType::Uint32},
    {"float", NumberType::Float32},  {"float32", NumberType::Float32}, {"double", NumberType::Float64},
    {"float64", NumberType::Float64}};

struct Property {
  std::string name;
  NumberType type = NumberType::Float32;
  bool is_list = false;
  NumberType length_type = NumberType::Uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& file) : file_(file.string()), text_(contents(file)) {}

  TriangleMesh read()
  {
    read_header();
    for (const PlyElement& element : elements_)
      read_element(element);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const
  {
    fail_input("{}: cannot be read as ply: {}; write the file again", file_, why);
  }

  // ---- header ----

  std::string line()
  {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string found = text_.substr(position_, end - position_);
    position_ = std::min(end + 1, text_.size());
    if (!found.empty() && found.back() == '\r')
      found.pop_back();
    return found;
  }

  void read_header()
  {
    if (line() != "ply")
      refuse("it doesn't start with \"ply\"");
    while (position_ < text_.size()) {
      std::istringstream words(line());
      std::string keyword;
      words >> keyword;
      if (keyword == "format")
        read_format(words);
      else if (keyword == "element")
        read_element_header(words);
      else if (keyword == "property")
        read_property(words);
      else if (keyword == "end_header")
        return;
      else if (keyword != "comment" && keyword != "obj_info")
        refuse(fmt::format("'{:.40}' is unknown in its header", keyword));
    }
    refuse("its header has no end");
  }

  void read_format(std::istringstream& words)
  {
    std::string format;
    words >> format;
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
      refuse(fmt::format("format '{:.40}' is unknown", format));
    ascii_ = format == "ascii";
    swapped_ = (format == "binary_big_endian") != (std::endian::native == std::endian::big);
  }

  void read_element_header(std::istringstream& words)
  {
    PlyElement element;
    words >> element.name >> element.count;
    // Each has a byte at least, so no file makes us read more than its own size.
    if (!words || element.count < 0 || static_cast<std::size_t>(element.count) > text_.size())
      refuse(fmt::format("element '{:.40}' must have a number, which the file can hold", element.name));
    elements_.push_back(element);
  }

  void read_property(std::istringstream& words)
  {
    if (elements_.empty())
      refuse("a property comes before the first element");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      property.is_list = true;
      words >> type;
      property.length_type = number_type(type);
      words >> type;
    }
    property.type = number_type(type);
    words >> property.name;
    elements_.back().properties.push_back(property);
  }

  NumberType number_type(const std::string& name) const
  {
    const auto found = number_types.find(name);
    if (found == number_types.end())
      refuse(fmt::format("number type '{:.40}' is unknown", name));
    return found->second;
  }

  // ---- body ----

  void read_element(const PlyElement& element)
  {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    if (is_vertex)
      check_coordinates(element);
    for (long n = 0; n < element.count; ++n) {
      Vec3 x;
      for (const Property& property : element.properties) {
        if (property.is_list)
          read_list(property, is_face, n);
        else if (const double value = next(property.type); is_vertex && property.name.size() == 1)
          set_coordinate(x, property.name.front(), value);
      }
      if (is_vertex)
        mesh_.vertices.push_back(x);
    }
  }

  void check_coordinates(const PlyElement& vertex) const
  {
    for (const char* name : {"x", "y", "z"})
      if (std::none_of(vertex.properties.begin(), vertex.properties.end(),
                       [&](const Property& p) { return p.name == name && !p.is_list; }))
        refuse(fmt::format("its vertices have no {}", name));
  }

  static void set_coordinate(Vec3& x, char name, double value)
  {
    if (name >= 'x' && name <= 'z')
      x[name - 'x'] = value;
  }

  void read_list(const Property& property, bool is_face, long n)
  {
    const double length = next(property.length_type);
    const bool is_corners = is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
    if (is_corners && length != 3)
      fail_input("{}: polygon {} has {} corners; cut it into triangles (ParaView: Triangulate)", file_, n, length);
    std::array<int, 3> corners{};
    for (int i = 0; i < length; ++i) {
      const double value = next(property.type);
      if (is_corners)
        corners[i] = value >= 0 && value < std::numeric_limits<int>::max() ? static_cast<int>(value) : -1;
    }
    if (is_corners)
      mesh_.triangles.push_back(corners);
  }

  double next(NumberType type)
  {
    if (ascii_)
      return next_word();
    switch (type) {
      case NumberType::Int8:
        return next_bytes<std::int8_t>();
      case NumberType::Uint8:
        return next_bytes<std::uint8_t>();
      case NumberType::Int16:
        return next_bytes<std::int16_t>();
      case NumberType::Uint16:
        return next_bytes<std::uint16_t>();
      case NumberType::Int32:
        return next_bytes<std::int32_t>();
      case NumberType::Uint32:
        return next_bytes<std::uint32_t>();
      case NumberType::Float32:
        return next_bytes<float>();
      case NumberType::Float64:
        break;
    }
    return next_bytes<double>();
  }

  double next_word()
  {
    constexpr auto blanks = " \t\r\n";
    const std::size_t begin = text_.find_first_not_of(blanks, position_);
    if (begin == std::string::npos)
      refuse("it ends before all the elements its header promises");
    position_ = std::min(text_.find_first_of(blanks, begin), text_.size());
    const std::string word = text_.substr(begin, position_ - begin);
    const auto value = number<double>(word);
    if (!value)
      refuse(fmt::format("'{:.40}' must be a number", word));
    return *value;
  }

  template <class Number>
  double next_bytes()
  {
    std::array<char, sizeof(Number)> bytes;
    if (text_.size() - position_ < bytes.size())
      refuse("it ends before all the elements its header promises");
    std::memcpy(bytes.data(), text_.data() + position_, bytes.size());
    position_ += bytes.size();
    if (swapped_)
      std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<Number>(bytes));
  }

  std::string file_;
  std::string text_;
  std::size_t position_ = 0;
  bool ascii_ = true;
  bool swapped_ = false;
  std::vector<PlyElement> elements_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& file)
{
  return PlyReader(file).read();
}

}  // namespace luff::surface

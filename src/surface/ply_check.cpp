// SPDX-License-Identifier: BSD-3-Clause
// Does a PLY file hold all that its header promises?
#include "surface/ply_check.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace luff::surface {

namespace {

struct Property {
  std::string count_type;  ///< of a list's length; empty for a single number
  std::string type;
};

struct PlyElement {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false;
  bool big_endian = false;
  std::vector<PlyElement> elements;
};

const std::map<std::string, int> type_bytes{{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                            {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                            {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                            {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why)
{
  fail_input("{}: cannot be read as ply: {}; write the file again", file.string(), why);
}

int bytes(const std::filesystem::path& file, const std::string& type)
{
  const auto found = type_bytes.find(type);
  if (found == type_bytes.end())
    refuse(file, "unknown number type \"" + type + "\"");
  return found->second;
}

void read_property(const std::filesystem::path& file, std::istringstream& words, Header& header)
{
  Property property;
  words >> property.type;
  if (property.type == "list")
    words >> property.count_type >> property.type;
  if (header.elements.empty())
    refuse(file, "a property comes before the first element");
  bytes(file, property.type);
  if (!property.count_type.empty())
    bytes(file, property.count_type);
  header.elements.back().properties.push_back(property);
}

Header read_header(const std::filesystem::path& file, std::istream& in)
{
  Header header;
  std::string line, format;
  std::getline(in, line);
  if (line.rfind("ply", 0) != 0)
    refuse(file, "it doesn't start with \"ply\"");
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") {
      words >> format;
      header.ascii = format == "ascii";
      header.big_endian = format == "binary_big_endian";
    } else if (keyword == "element") {
      PlyElement element;
      words >> element.name >> element.count;
      header.elements.push_back(element);
    } else if (keyword == "property") {
      read_property(file, words, header);
    } else if (keyword == "end_header") {
      return header;
    }
  }
  refuse(file, "its header has no end");
}

/// Reads the numbers of the body one after the other, only to count them.
class Body {
 public:
  Body(const std::filesystem::path& file, const Header& header, std::istream& in)
      : file_(file), header_(header), in_(in)
  {
  }

  void skip_number(const std::string& type)
  {
    if (header_.ascii) {
      in_ >> word_;
    } else {
      char raw[8];
      in_.read(raw, bytes(file_, type));
    }
    require_more();
  }

  long list_length(const std::string& type)
  {
    long length = 0;
    if (header_.ascii) {
      in_ >> length;
    } else {
      const int n = bytes(file_, type);
      unsigned char raw[8] = {};
      in_.read(reinterpret_cast<char*>(raw), n);
      for (int i = 0; i < n; ++i)
        length = 256 * length + raw[header_.big_endian ? i : n - 1 - i];
    }
    require_more();
    return length;
  }

 private:
  void require_more() const
  {
    if (!in_)
      refuse(file_, "it ends before all the elements its header promises");
  }

  const std::filesystem::path& file_;
  const Header& header_;
  std::istream& in_;
  std::string word_;
};

}  // namespace

void check_ply_is_complete(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  const Header header = read_header(file, in);
  Body body(file, header, in);
  for (const PlyElement& element : header.elements)
    for (long i = 0; i < element.count; ++i)
      for (const Property& property : element.properties) {
        const long n = property.count_type.empty() ? 1 : body.list_length(property.count_type);
        for (long k = 0; k < n; ++k)
          body.skip_number(property.type);
      }
}

}  // namespace luff::surface

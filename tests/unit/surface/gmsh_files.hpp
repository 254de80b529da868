// SPDX-License-Identifier: BSD-3-Clause
// The same small mesh in each of Gmsh's formats.
#pragma once

#include <cstdint>
#include <string>

namespace luff::test {

/// The square of two triangles whose nodes have the numbers 1, 2, 5 and 7; a curve "left", a corner without name, and a
/// surface "skin". Node 9 belongs to nothing.
inline std::string gmsh_2_ascii()
{
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n2\n1 4 \"left\"\n2 3 \"skin of it\"\n$EndPhysicalNames\n"
         "$Nodes\n5\n1 0 0 0\n2 1 0 0\n5 1 1 0\n7 0 1 0.5\n9 8 8 8\n$EndNodes\n"
         "$Elements\n4\n1 15 2 11 1 2\n2 1 2 4 1 7 1\n3 2 2 3 1 1 2 5\n4 2 2 3 1 1 5 7\n$EndElements\n";
}

inline std::string gmsh_4_ascii()
{
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n2\n1 4 \"left\"\n2 3 \"skin of it\"\n$EndPhysicalNames\n"
         "$Entities\n1 1 1 0\n2 1 0 0 1 11\n1 0 0 0 0 1 0.5 1 4 0\n1 0 0 0 1 1 0.5 1 3 1 1\n$EndEntities\n"
         "$Comments\nmade by hand\n$EndComments\n"
         "$Nodes\n2 5 1 9\n1 1 1 2\n1\n7\n0 0 0 0.5\n0 1 0.5 0.25\n2 1 0 3\n2\n5\n9\n1 0 0\n1 1 0\n8 8 8\n$EndNodes\n"
         "$Elements\n3 4 1 4\n0 2 15 1\n1 2\n1 1 1 1\n2 7 1\n2 1 2 2\n3 1 2 5\n4 1 5 7\n$EndElements\n";
}

/// Appends numbers as bytes.
class Bytes {
 public:
  explicit Bytes(std::string text) : text_(std::move(text)) {}
  Bytes& words(const std::string& words)
  {
    text_ += words;
    return *this;
  }
  template <class Number, class... More>
  Bytes& numbers(Number first, More... more)
  {
    text_.append(reinterpret_cast<const char*>(&first), sizeof first);
    if constexpr (sizeof...(more) > 0)
      numbers(more...);
    return *this;
  }
  Bytes& ints(std::initializer_list<std::int32_t> values)
  {
    for (const std::int32_t value : values)
      numbers(value);
    return *this;
  }
  Bytes& sizes(std::initializer_list<std::uint64_t> values)
  {
    for (const std::uint64_t value : values)
      numbers(value);
    return *this;
  }
  Bytes& reals(std::initializer_list<double> values)
  {
    for (const double value : values)
      numbers(value);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

inline std::string gmsh_2_binary()
{
  Bytes file("$MeshFormat\n2.2 1 8\n");
  file.ints({1}).words(
      "\n$EndMeshFormat\n$PhysicalNames\n2\n1 4 \"left\"\n2 3 \"skin of it\"\n$EndPhysicalNames\n$Nodes\n5\n");
  file.ints({1}).reals({0, 0, 0}).ints({2}).reals({1, 0, 0}).ints({5}).reals({1, 1, 0});
  file.ints({7}).reals({0, 1, 0.5}).ints({9}).reals({8, 8, 8}).words("\n$EndNodes\n$Elements\n4\n");
  file.ints({15, 1, 2, 1, 11, 1, 2, 1, 1, 2, 2, 4, 1, 7, 1, 2, 2, 2, 3, 3, 1, 1, 2, 5, 4, 3, 1, 1, 5, 7});
  return file.words("\n$EndElements\n").text();
}

inline std::string gmsh_4_binary()
{
  Bytes file("$MeshFormat\n4.1 1 8\n");
  file.ints({1}).words(
      "\n$EndMeshFormat\n$PhysicalNames\n2\n1 4 \"left\"\n2 3 \"skin of it\"\n$EndPhysicalNames\n$Entities\n");
  file.sizes({1, 1, 1, 0}).ints({2}).reals({1, 0, 0}).sizes({1}).ints({11});
  file.ints({1}).reals({0, 0, 0, 0, 1, 0.5}).sizes({1}).ints({4}).sizes({0});
  file.ints({1})
      .reals({0, 0, 0, 1, 1, 0.5})
      .sizes({1})
      .ints({3})
      .sizes({1})
      .ints({1})
      .words("\n$EndEntities\n$Nodes\n");
  file.sizes({2, 5, 1, 9}).ints({1, 1, 1}).sizes({2, 1, 7}).reals({0, 0, 0, 0.5, 0, 1, 0.5, 0.25});
  file.ints({2, 1, 0}).sizes({3, 2, 5, 9}).reals({1, 0, 0, 1, 1, 0, 8, 8, 8}).words("\n$EndNodes\n$Elements\n");
  file.sizes({3, 4, 1, 4}).ints({0, 2, 15}).sizes({1, 1, 2}).ints({1, 1, 1}).sizes({1, 2, 7, 1});
  file.ints({2, 1, 2}).sizes({2, 3, 1, 2, 5, 4, 1, 5, 7});
  return file.words("\n$EndElements\n").text();
}

}  // namespace luff::test

// SPDX-License-Identifier: BSD-3-Clause
#include "grid/files/plot3d_text.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "grid/files/dimensions.hpp"

namespace luff::grid {

namespace {

/// Numbers of a text one after the other.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& file) : file_(file), in_(file) {}

  /// What the next line with words holds; counts it.
  std::vector<int> integers_of_line()
  {
    std::string line;
    do {
      if (!std::getline(in_, line))
        fail_input("{}: holds no dimensions", file_.string());
      ++line_;
    } while (line.find_first_not_of(" \t\r,") == std::string::npos);
    std::vector<int> values;
    separate(line);
    std::istringstream words(line);
    for (std::string word; words >> word;)
      values.push_back(integer(word));
    return values;
  }

  /// False where the text ends.
  bool next(double& value)
  {
    while (repeats_ == 0) {
      std::string word;
      while (!(words_ >> word)) {
        std::string line;
        if (!std::getline(in_, line))
          return false;
        ++line_;
        separate(line);
        words_.clear();
        words_.str(line);
      }
      parse(word);
    }
    --repeats_;
    value = value_;
    return true;
  }

 private:
  static void separate(std::string& line) { std::replace(line.begin(), line.end(), ',', ' '); }

  [[noreturn]] void refuse(const std::string& word, const char* wanted) const
  {
    fail_input("{}:{}: '{}' must be {}", file_.string(), line_, word, wanted);
  }

  int integer(const std::string& word) const
  {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      refuse(word, "a number of blocks or nodes");
    return value;
  }

  /// 1.5, +1.5D-3, 3*0.0
  void parse(const std::string& word)
  {
    std::string_view text = word;
    repeats_ = 1;
    if (const auto star = text.find('*'); star != std::string_view::npos) {
      repeats_ = integer(word.substr(0, star));
      text.remove_prefix(star + 1);
    }
    std::string plain(text.starts_with('+') ? text.substr(1) : text);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value_);
    if (error != std::errc() || end != plain.data() + plain.size() || repeats_ < 1)
      refuse(word, "a coordinate");
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::istringstream words_;
  int line_ = 0;
  int repeats_ = 0;
  double value_ = 0.0;
};

Index3 read_dimensions(Numbers& numbers, const std::string& file)
{
  std::vector<int> line = numbers.integers_of_line();
  if (line.size() == 1) {
    require_one_block(line[0], file);
    line = numbers.integers_of_line();
  }
  if (line.size() != 3)
    fail_input(
        "{}: begins with {} numbers on a line; a grid begins with its three numbers of nodes, or with the number "
        "of blocks on a line of its own",
        file, line.size());
  const Index3 nodes{line[0], line[1], line[2]};
  require_cells(nodes, file);
  return nodes;
}

std::vector<Vec3> read_nodes(const std::filesystem::path& file, const Index3& size, const IndexBox& box)
{
  Numbers numbers(file);
  (void)read_dimensions(numbers, file.string());
  std::vector<Vec3> nodes(box.volume());
  const double all = 3.0 * size[0] * size[1] * size[2];
  double read = 0.0;
  for (int d = 0; d < 3; ++d) {
    std::size_t n = 0;
    for_each_cell_in_order({{0, 0, 0}, size}, [&](int i, int j, int k) {
      double value = 0.0;
      if (!numbers.next(value))
        fail_input("{}: ends after {:.0f} coordinates; {} x {} x {} nodes have {:.0f}", file.string(), read, size[0],
                   size[1], size[2], all);
      ++read;
      if (box.contains(i, j, k))
        nodes[n++][d] = value;
    });
  }
  return nodes;
}

}  // namespace

bool is_plot3d_text(const std::filesystem::path& file)
{
  std::array<char, 256> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  constexpr std::string_view allowed = "0123456789+-.*eEdD, \t\r\nnNaAiIfF";
  return std::all_of(head.begin(), head.begin() + in.gcount(),
                     [&](char c) { return allowed.find(c) != std::string_view::npos; });
}

CurvilinearNodes open_plot3d_text(const std::filesystem::path& file)
{
  Numbers numbers(file);
  const Index3 size = read_dimensions(numbers, file.string());
  return {{size[0] - 1, size[1] - 1, size[2] - 1},
          [file, size](const IndexBox& box) { return read_nodes(file, size, box); }};
}

}  // namespace luff::grid

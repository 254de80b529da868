// SPDX-License-Identifier: BSD-3-Clause
// Numbers from the text of a file.
#pragma once

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace luff::surface {

inline std::string contents(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The number that the word is, all of it.
template <class Number>
std::optional<Number> number(std::string_view word)
{
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    return std::nullopt;
  return value;
}

}  // namespace luff::surface

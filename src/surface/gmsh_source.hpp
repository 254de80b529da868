// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a Gmsh file one after the other, written as text or as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace luff::surface {

/// All members throw InputError with file and place where the file is not as expected.
class GmshSource {
 public:
  explicit GmshSource(const std::filesystem::path& file);

  void set_binary(bool binary) { binary_ = binary; }
  bool binary() const { return binary_; }

  /// Text up to the next blank, which is always text, or empty at the end of the file.
  std::string word();
  /// Text in quotes.
  std::string quoted();
  /// Numbers of the current kind: int and size_t of 4 and 8 bytes.
  long integer();
  long size();
  double real();
  /// As size() and integer(), where they say how many items of at least one byte follow.
  long count();
  long integer_count();
  /// Numbers that are text even in a binary file.
  long text_integer();
  long text_count();
  /// To the start of the next line.
  void skip_line_end();
  /// To behind the next line that is this text.
  void skip_past(std::string_view line);
  bool at_end();

  [[noreturn]] void refuse(std::string_view why) const;

 private:
  template <class Number>
  Number bytes();
  template <class Number>
  Number parsed(std::string_view kind);
  void skip_blanks();
  long checked_count(long n) const;

  std::string file_;
  std::string text_;
  std::size_t position_ = 0;
  bool binary_ = false;
};

}  // namespace luff::surface

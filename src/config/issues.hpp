// SPDX-License-Identifier: BSD-3-Clause
// Everything that is wrong with a case, collected so that it can be told at once.
#pragma once

#include <string>
#include <vector>

namespace luff::config {

/// Where something was written: a line of a file, or an argument of the command line.
struct Place {
  std::string source;  ///< "case.toml", or "--set time.end=2"
  int line = 0;        ///< 0: the whole of it

  std::string text() const;
  bool is_argument() const;
};

class Issues {
 public:
  void add(const Place& place, const std::string& text);
  std::size_t count() const { return issues_.size(); }

  /// \throws InputError with a line for each issue, in the order of the file, if there are any.
  void throw_if_any() const;

 private:
  struct Issue {
    Place place;
    std::string text;
  };
  std::vector<Issue> issues_;
};

}  // namespace luff::config

// SPDX-License-Identifier: BSD-3-Clause
// The two errors a user can meet, and the assertion a programmer can.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

namespace luff {

/// The input is wrong: the message says where, which value, what is allowed and what would fix it.
/// Thrown before anything is allocated or written; the program exits with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run cannot go on: the message says when, where, which value and what may help.
/// What was written stays readable; the program exits with status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An iteration inside a step did not converge: a shorter step may.
class NonConvergence : public RunError {
 public:
  using RunError::RunError;
};

template <class... Args>
[[noreturn]] void fail_input(fmt::format_string<Args...> text, Args&&... args)
{
  throw InputError(fmt::format(text, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void fail_run(fmt::format_string<Args...> text, Args&&... args)
{
  throw RunError(fmt::format(text, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void fail_to_converge(fmt::format_string<Args...> text, Args&&... args)
{
  throw NonConvergence(fmt::format(text, std::forward<Args>(args)...));
}

/// A condition that only a programming error can break.
inline void ensure(bool condition, const char* text, std::source_location where = std::source_location::current())
{
  if (!condition)
    throw std::logic_error(fmt::format("{}:{}: internal error: {}", where.file_name(), where.line(), text));
}

}  // namespace luff

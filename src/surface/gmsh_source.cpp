// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a Gmsh file one after the other.
#include "surface/gmsh_source.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "core/error.hpp"
#include "surface/file_text.hpp"

namespace luff::surface {

namespace {

bool is_blank(char c)
{
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

GmshSource::GmshSource(const std::filesystem::path& file) : file_(file.string()), text_(contents(file)) {}

void GmshSource::refuse(std::string_view why) const
{
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position_), '\n');
  const std::string place = binary_ ? fmt::format("byte {}", position_) : fmt::format("line {}", line);
  fail_input("{}: cannot be read as msh: {}, {}; write the file again", file_, place, why);
}

void GmshSource::skip_blanks()
{
  while (position_ < text_.size() && is_blank(text_[position_]))
    ++position_;
}

std::string GmshSource::word()
{
  skip_blanks();
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]))
    ++position_;
  return text_.substr(begin, position_ - begin);
}

std::string GmshSource::quoted()
{
  skip_blanks();
  if (position_ >= text_.size() || text_[position_] != '"')
    refuse("a name in quotes is missing");
  const std::size_t begin = position_ + 1;
  const std::size_t end = text_.find('"', begin);
  if (end == std::string::npos)
    refuse("a name's quotes don't end");
  position_ = end + 1;
  return text_.substr(begin, end - begin);
}

template <class Number>
Number GmshSource::bytes()
{
  Number value{};
  if (text_.size() - position_ < sizeof value)
    refuse("it ends too early");
  std::memcpy(&value, text_.data() + position_, sizeof value);
  position_ += sizeof value;
  return value;
}

template <class Number>
Number GmshSource::parsed(std::string_view kind)
{
  const std::string text = word();
  if (text.empty())
    refuse("it ends too early");
  const auto value = number<Number>(text);
  if (!value)
    refuse(fmt::format("'{:.40}' must be {}", text, kind));
  return *value;
}

long GmshSource::text_integer()
{
  return parsed<long>("an integer");
}

long GmshSource::integer()
{
  return binary_ ? bytes<std::int32_t>() : text_integer();
}

long GmshSource::size()
{
  return binary_ ? static_cast<long>(bytes<std::uint64_t>()) : text_integer();
}

double GmshSource::real()
{
  return binary_ ? bytes<double>() : parsed<double>("a number");
}

long GmshSource::checked_count(long n) const
{
  // An honest file has a byte at least for each item: so no file makes us reserve more than its own size.
  if (n < 0 || static_cast<std::size_t>(n) > text_.size() - position_)
    refuse(fmt::format("{} items are more than the file can hold", n));
  return n;
}

long GmshSource::count()
{
  return checked_count(size());
}

long GmshSource::integer_count()
{
  return checked_count(integer());
}

long GmshSource::text_count()
{
  return checked_count(text_integer());
}

void GmshSource::skip_line_end()
{
  position_ = std::min(text_.find('\n', position_), text_.size() - 1) + 1;
}

void GmshSource::skip_past(std::string_view line)
{
  const std::size_t found = text_.find(line, position_);
  if (found == std::string::npos)
    refuse(fmt::format("{} is missing", line));
  position_ = found + line.size();
}

bool GmshSource::at_end()
{
  skip_blanks();
  return position_ >= text_.size();
}

}  // namespace luff::surface

// SPDX-License-Identifier: BSD-3-Clause
// Case files broken at random: each is read or refused with a reason, and none crashes.
#include <random>

#include "case_text.hpp"

namespace luff::config {
namespace {

/// Breaks texts in one of several ways, always the same for the same seed.
class Breaker {
 public:
  explicit Breaker(unsigned seed) : random_(seed) {}

  std::string broken(std::string text)
  {
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(20, text.size() - at));
    switch (below(6)) {
      case 0:
        return text.erase(at, length);
      case 1:
        return text.replace(at, 1, 1, static_cast<char>(below(256)));
      case 2:
        return text.replace(at, length, fragments_[below(fragments_.size())]);
      case 3:
        return text.insert(at, fragments_[below(fragments_.size())]);
      case 4:
        return with_another_digit(text, at);
      default:
        return without_line(text, at);
    }
  }
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

 private:
  std::string with_another_digit(std::string text, std::size_t at)
  {
    const auto digit = text.find_first_of("0123456789", at);
    return digit == std::string::npos ? text : text.replace(digit, 1, 1, static_cast<char>('0' + below(10)));
  }
  static std::string without_line(std::string text, std::size_t at)
  {
    const auto begin = text.rfind('\n', at);
    return begin == std::string::npos ? text : text.erase(begin, text.find('\n', begin + 1) - begin);
  }

  std::mt19937 random_;
  std::vector<std::string> fragments_{"0",      "-1",   "1e400",      "nan",    "\"\"",
                                      "[]",     "{}",   "[[",         "]]",     "=",
                                      "\n",     "true", "[0]",        "\"x\"",  "}",
                                      "{",      "#",    "1979-05-27", "\"\"\"", ".",
                                      "\"(x\"", "0x10", "1_000",      "'",      "{ a = [ { b = 1 } ] }"};
};

/// Whether the text was read (and not refused).
bool expect_read_or_refused(const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder.write("case.toml", text);
  try {
    const Case options = load_case(file);
    std::ostringstream resolved;
    write_case(options, resolved);
    EXPECT_EQ(load_case(folder.write("resolved.toml", resolved.str())), options) << text;
    return true;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("case.toml"), std::string::npos) << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << " in\n" << text;
  }
  return false;
}

TEST(BrokenCaseFiles, AreReadOrRefusedWithTheNameOfTheFile)
{
  constexpr int tries = 2000;
  int read = 0;
  Breaker breaker(1);
  for (int i = 0; i < tries; ++i) {
    std::string text = small_case;
    const std::size_t breaks = 1 + breaker.below(3);
    for (std::size_t b = 0; b < breaks; ++b)
      text = breaker.broken(text);
    read += expect_read_or_refused(text) ? 1 : 0;
  }
  EXPECT_GT(read, tries / 50);
  EXPECT_LT(read, tries / 2);
}

TEST(CaseFilesWithoutOneLine, AreReadOrRefusedWithTheNameOfTheFile)
{
  std::size_t begin = 0;
  for (std::size_t end = small_case.find('\n'); end != std::string::npos; end = small_case.find('\n', begin)) {
    expect_read_or_refused(std::string(small_case).erase(begin, end + 1 - begin));
    begin = end + 1;
  }
}

TEST(CaseFilesCutShort, AreReadOrRefusedWithTheNameOfTheFile)
{
  for (std::size_t length = 0; length < small_case.size(); length += 3)
    expect_read_or_refused(small_case.substr(0, length));
}

}  // namespace
}  // namespace luff::config

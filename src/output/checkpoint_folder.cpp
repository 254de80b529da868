// SPDX-License-Identifier: BSD-3-Clause
#include "output/checkpoint_folder.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/ranges.h>

#include "core/error.hpp"
#include "output/checkpoint_file.hpp"
#include "output/integrity.hpp"
#include "parallel/broadcast.hpp"

namespace luff::output {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view stem = "checkpoint-", ending = ".h5", unfinished = ".h5.tmp";

std::optional<long> step_of(const std::string& name, std::string_view end)
{
  if (!name.starts_with(stem) || !name.ends_with(end) || name.size() <= stem.size() + end.size())
    return std::nullopt;
  long step = 0;
  const char* const last = name.data() + name.size() - end.size();
  const auto [stop, error] = std::from_chars(name.data() + stem.size(), last, step);
  return error == std::errc() && stop == last ? std::optional(step) : std::nullopt;
}

struct Numbered {
  long step;
  fs::path file;
};

/// Newest first.
std::vector<Numbered> list(const fs::path& folder, std::string_view end)
{
  std::vector<Numbered> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), last; !error && entry != last; entry.increment(error))
    if (const auto step = step_of(entry->path().filename().string(), end))
      files.push_back({*step, entry->path()});
  std::sort(files.begin(), files.end(), [](const Numbered& a, const Numbered& b) { return a.step > b.step; });
  return files;
}

void discard(const fs::path& file)
{
  std::error_code ignored;  // another one too many does no harm
  fs::remove(file, ignored);
}

/// What the first rank finds, on every rank.
std::vector<fs::path> candidates(MPI_Comm comm, const fs::path& folder_or_file)
{
  std::string names;
  std::error_code error;
  if (fs::is_directory(folder_or_file, error))
    for (const Numbered& one : list(folder_or_file, ending))
      names += one.file.string() + '\n';
  else if (fs::exists(folder_or_file, error))
    names = folder_or_file.string() + '\n';
  names = broadcast(comm, std::move(names));
  std::vector<fs::path> files;
  for (std::size_t from = 0, to = 0; (to = names.find('\n', from)) != std::string::npos; from = to + 1)
    files.emplace_back(names.substr(from, to - from));
  return files;
}

}  // namespace

std::string checkpoint_name(long step)
{
  return fmt::format("{}{:08}{}", stem, step, ending);
}

void keep_last_two(const RunFolder& folder, long newest_step)
{
  if (!folder.writes())
    return;
  int kept = 0;
  for (const Numbered& one : list(folder.path(), ending))
    if (one.step != newest_step && ++kept > 1)
      discard(one.file);
  for (const Numbered& one : list(folder.path(), unfinished))
    discard(one.file);
}

void drop_checkpoints_after(const RunFolder& folder, long step)
{
  if (!folder.writes())
    return;
  for (const Numbered& one : list(folder.path(), ending))
    if (one.step > step)
      discard(one.file);
}

FoundCheckpoint find_checkpoint(MPI_Comm comm, const fs::path& folder_or_file)
{
  FoundCheckpoint found;
  for (const fs::path& file : candidates(comm, folder_or_file)) {
    const std::string reason = broken_seal(comm, file, checkpoint_format);
    if (reason.empty()) {
      found.file = file;
      return found;
    }
    found.passed_over.push_back(fmt::format("{} is not used: {}", file.string(), reason));
  }
  if (found.passed_over.empty())
    fail_input(
        "--restart {}: there is no checkpoint; give the folder of a run that has a file checkpoint-*.h5, or such a "
        "file",
        folder_or_file.string());
  fail_input("--restart {}: no checkpoint can be used\n  {}", folder_or_file.string(),
             fmt::join(found.passed_over, "\n  "));
}

}  // namespace luff::output

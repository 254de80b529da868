// SPDX-License-Identifier: BSD-3-Clause
// Two sinks behind one logger.
#include "output/log.hpp"

#include <string>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include "core/error.hpp"
#include "output/terminal.hpp"

namespace luff::output {

namespace {

spdlog::sink_ptr console_sink()
{
  auto sink = std::make_shared<spdlog::sinks::stdout_color_sink_st>();
  // The live progress line may stand there already.
  sink->set_pattern(standard_output_is_terminal() ? std::string(clear_line) + "%^%v%$" : "%v");
  return sink;
}

spdlog::sink_ptr file_sink(const std::filesystem::path& file)
{
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), /*truncate=*/false);
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e  %-7l  %v");
    return sink;
  } catch (const spdlog::spdlog_ex& error) {
    fail_run("{}: cannot be written ({})", file.string(), error.what());
  }
}

}  // namespace

std::shared_ptr<spdlog::logger> make_log(const RunFolder& folder)
{
  if (!folder.writes())
    return std::make_shared<spdlog::logger>("luff", spdlog::sinks_init_list{});
  auto log = std::make_shared<spdlog::logger>(
      "luff", spdlog::sinks_init_list{console_sink(), file_sink(folder.file("log.txt"))});
  log->flush_on(spdlog::level::trace);
  return log;
}

}  // namespace luff::output

// SPDX-License-Identifier: BSD-3-Clause
// The program: reads the command line and calls a command.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <mpi.h>
#include <omp.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "config/case.hpp"
#include "core/error.hpp"
#include "parallel/agreement.hpp"
#include "simulation/commands.hpp"

namespace {

volatile std::sig_atomic_t interrupts = 0;

/// The first Ctrl-C ends the run after the step; the second ends the program at once.
extern "C" void on_interrupt(int)
{
  interrupts = interrupts + 1;
  if (interrupts > 1)
    _exit(130);
}

/// Cores of this machine for each of its ranks.
int cores_per_rank()
{
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int ranks = 1;
  MPI_Comm_size(node, &ranks);
  MPI_Comm_free(&node);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks);
}

/// --threads, or OMP_NUM_THREADS, or as many of the cores as the case can feed.
luff::simulation::Threads choose_threads(int wanted)
{
  if (wanted > 0)
    omp_set_num_threads(wanted);
  else if (std::getenv("OMP_NUM_THREADS") == nullptr)
    return {.at_most = cores_per_rank()};
  return {};
}

/// Pictures of a run, by tools/plot.py; returns its exit status.
int plot(const std::filesystem::path& run)
{
  if (!std::filesystem::is_directory(run))
    luff::fail_input("plot: {} is not a folder; give the folder of a run, such as runs/flag/001", run.string());
  const char* root = std::getenv("LUFF_ROOT");
  const std::string script = std::string(root != nullptr ? root : LUFF_SOURCE_DIR) + "/tools/plot.py";
  std::string folder = run.string();
  std::string name = "python3";
  std::string path = script;
  char* arguments[] = {name.data(), path.data(), folder.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, "/usr/bin/python3", nullptr, nullptr, arguments, environ) != 0)
    return 1;
  int status = 1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// Tells what went wrong, once, and ends the other ranks if they don't know.
int fail(const char* what, int status)
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  // In one piece: the launcher of ranks mixes what comes in several with other lines.
  const auto say = [line = fmt::format("luff: {}\n", what)] { std::cerr << line << std::flush; };
  if (rank == 0)
    say();
  if (!luff::all_ranks_arrive(MPI_COMM_WORLD)) {
    if (rank != 0)
      say();
    MPI_Abort(MPI_COMM_WORLD, status);
  }
  return status;
}

/// Runs a command; the exit status is 2 when the input is wrong and 1 when the run failed.
template <class Command>
int guarded(Command command)
{
  try {
    command();
    return 0;
  } catch (const luff::InputError& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);

  CLI::App app{"luff: fluid-structure interaction of thin flexible shells"};
  app.require_subcommand(1);
  std::string file;
  std::string out;
  std::string restart;
  luff::config::Overrides overrides;
  int threads = 0;
  const auto takes_case = [&](CLI::App* command) {
    command->add_option("case", file, "Case file (TOML)")->required();
    command->add_option("--set", overrides.sets, "Override a key: --set time.end=2")->take_all()->expected(1);
    command->add_option("--resolution", overrides.resolution, "Scale cell and division counts, and the step")
        ->check(CLI::PositiveNumber);
    return command;
  };
  CLI::App* run = takes_case(app.add_subcommand("run", "Run a case"));
  run->add_option("--out", out, "Folder to write to (default: runs/<case>/<nnn>)");
  run->add_option("--restart", restart, "Go on from the last checkpoint of a run's folder, or from a checkpoint file");
  run->add_option("--threads", threads, "Threads per rank")->check(CLI::PositiveNumber);
  CLI::App* check = takes_case(app.add_subcommand("check", "Validate a case; print groups, size and cost"));
  CLI::App* mesh = takes_case(app.add_subcommand("mesh", "Write grid and surfaces without running"));
  mesh->add_option("--out", out, "Folder to write to")->required();
  CLI::App* options = app.add_subcommand("options", "Print the reference of all keys of a case file");
  bool markdown = false;
  options->add_flag("--markdown", markdown, "As a page of the manual");
  CLI::App* pictures = app.add_subcommand("plot", "Make pictures of a run");
  pictures->add_option("run", file, "Folder of the run")->required();

  int status = 0;
  try {
    app.parse(argc, argv);
    const luff::simulation::Threads available = choose_threads(threads);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow any more is an error like a full disk
    status = guarded([&] {
      using namespace luff::simulation;
      if (run->parsed())
        run_case(MPI_COMM_WORLD, file, overrides,
                 {.out = out,
                  .restart = restart,
                  .threads = available,
                  .interrupted = [] { return interrupts > 0; },
                  .make_pictures = plot});
      else if (check->parsed())
        check_case(MPI_COMM_WORLD, file, overrides);
      else if (mesh->parsed())
        write_meshes(MPI_COMM_WORLD, file, overrides, out);
      else if (options->parsed() && rank == 0)
        luff::config::write_reference(std::cout,
                                      markdown ? luff::config::Format::Markdown : luff::config::Format::Text);
      else if (pictures->parsed())
        if (rank == 0 && plot(file) != 0)
          luff::fail_run("no pictures were made of '{}'", file);
    });
  } catch (const CLI::ParseError& error) {
    status = rank == 0 ? app.exit(error) : error.get_exit_code();
    if (status != 0)
      status = 2;
  }
  MPI_Finalize();
  return status;
}

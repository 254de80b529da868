// SPDX-License-Identifier: BSD-3-Clause
// Runs the program as a user does: in a folder of its own, with its output and exit status caught.
#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace luff::test {

inline std::string contents_of(const std::filesystem::path& file)
{
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A new folder, removed with all that is in it at the end of the test.
class WorkFolder {
 public:
  WorkFolder()
  {
    std::string name = std::filesystem::temp_directory_path() / "luff-test-XXXXXX";
    path_ = mkdtemp(name.data());
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  [[nodiscard]] std::string read(const std::filesystem::path& name) const { return contents_of(path_ / name); }
  [[nodiscard]] bool has(const std::filesystem::path& name) const { return std::filesystem::exists(path_ / name); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What a program said, both streams together, and how it ended.
struct Outcome {
  int status = -1;  ///< of exit; 128 + signal where one ended it
  std::string said;
};

/// The environment of a program started by hand: no trace of the MPI job that the test itself is.
inline std::vector<std::string> plain_environment(const std::map<std::string, std::string>& also)
{
  std::vector<std::string> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    const bool of_the_job = (name.starts_with("OMPI_") && !name.starts_with("OMPI_MCA_rmaps") &&
                             !name.starts_with("OMPI_MCA_mpi_") && !name.starts_with("OMPI_ALLOW")) ||
                            name.starts_with("PMIX_") || name.starts_with("PRTE_") || name.starts_with("ORTE_");
    if (!of_the_job && !also.contains(name))
      kept.push_back(text);
  }
  for (const auto& [name, value] : also)
    kept.push_back(name + "=" + value);
  return kept;
}

/// A program that runs beside the test.
class Process {
 public:
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder,
          const std::map<std::string, std::string>& environment = {})
      : output_(folder / ".output")
  {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    const std::vector<std::string> variables = plain_environment(environment);
    started_ = posix_spawnp(&id_, command.front().c_str(), &actions, nullptr, pointers(command).data(),
                            pointers(variables).data()) == 0;
    EXPECT_TRUE(started_) << command.front();
    posix_spawn_file_actions_destroy(&actions);
  }

  void signal(int number) const { kill(id_, number); }
  [[nodiscard]] pid_t id() const { return id_; }

  /// What the program said until now.
  [[nodiscard]] std::string said() const { return contents_of(output_); }

  /// Waits until the program ends; ends it after five.
  Outcome wait()
  {
    int state = 0;
    for (int n = 0; waitpid(id_, &state, WNOHANG) == 0; ++n) {
      if (n == 30000) {
        ADD_FAILURE() << "the program hangs; it said\n" << said();
        kill(id_, SIGKILL);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    Outcome outcome{WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state), said()};
    std::filesystem::remove(output_);
    return outcome;
  }

 private:
  static std::vector<char*> pointers(const std::vector<std::string>& texts)
  {
    std::vector<char*> result;
    for (const std::string& text : texts)
      result.push_back(const_cast<char*>(text.c_str()));
    result.push_back(nullptr);
    return result;
  }

  std::filesystem::path output_;
  pid_t id_ = -1;
  bool started_ = false;
};

/// `luff` with these arguments, in this folder.
inline Outcome luff(const WorkFolder& folder, std::vector<std::string> arguments,
                    std::map<std::string, std::string> environment = {})
{
  environment.insert({{"OMPI_MCA_btl", "self"}, {"OMPI_MCA_pml", "ob1"}});  // a rank alone starts faster
  arguments.insert(arguments.begin(), LUFF_BINARY);
  return Process(arguments, folder.path(), environment).wait();
}

/// `mpirun -n ranks luff` with these arguments, in this folder.
inline Outcome luff_on_ranks(int ranks, const WorkFolder& folder, const std::vector<std::string>& arguments)
{
  std::vector<std::string> command{"mpirun", "--quiet", "--oversubscribe", "-n", std::to_string(ranks), LUFF_BINARY};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(command, folder.path(),
                 {{"OMP_NUM_THREADS", "1"},
                  {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                  {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                  {"OMPI_MCA_mpi_yield_when_idle", "1"}})
      .wait();
}

}  // namespace luff::test

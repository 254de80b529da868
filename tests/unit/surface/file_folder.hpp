// SPDX-License-Identifier: BSD-3-Clause
// Mesh files that a test writes and reads.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "surface/readers.hpp"

namespace luff::test {

/// A folder of this test's own, removed at its end.
class FileFolder : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// The message with which read_mesh() refuses the file; nothing may be printed.
  static std::string refusal(const std::filesystem::path& file, surface::Repair repair = surface::Repair::Yes)
  {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      (void)surface::read_mesh(file, repair);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
    if (message != "accepted") {
      EXPECT_NE(message.find(file.filename().string()), std::string::npos) << message;
    }
    return message;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("luff-readers-" + std::to_string(::getpid()));
};

}  // namespace luff::test

// SPDX-License-Identifier: BSD-3-Clause
// VTK's readers without what they print: it becomes part of our own messages.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include "core/error.hpp"

namespace luff::vtk {

/// Collects what VTK would print.
class Transcript : public vtkOutputWindow {
 public:
  static Transcript* New();
  void DisplayText(const char* text) override { text_ += text; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Puts a transcript in the place of VTK's output window and log for as long as it lives.
class Listening {
 public:
  Listening();
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;
  ~Listening();

  [[nodiscard]] bool heard_nothing() const { return transcript_->text().empty(); }
  /// One line of VTK's complaint, without its addresses.
  [[nodiscard]] std::string complaint() const;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_before_;
  vtkNew<Transcript> transcript_;
};

/// Has a reader read: `update(reader)`.  Throws InputError with VTK's complaint when it has one; `kind` is what the
/// file should be.
template <class Reader, class Update>
void read(Reader& reader, const std::filesystem::path& file, const std::string& kind, Update update)
{
  const Listening listening;
  reader.SetFileName(file.c_str());
  const auto refuse = [&](const std::string& complaint) {
    fail_input("{}: cannot be read as {}: {}; write the file again", file.string(), kind, complaint);
  };
  try {
    update(reader);
  } catch (const std::exception& error) {  // of memory, where the file promises more than it holds
    refuse(error.what());
  }
  if (!listening.heard_nothing())
    refuse(listening.complaint());
}

}  // namespace luff::vtk

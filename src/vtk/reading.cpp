// SPDX-License-Identifier: BSD-3-Clause
#include "vtk/reading.hpp"

#include <algorithm>

#include <vtkObjectFactory.h>

namespace luff::vtk {

vtkStandardNewMacro(Transcript);

Listening::Listening()
    : before_(vtkOutputWindow::GetInstance()), verbosity_before_(vtkLogger::GetCurrentVerbosityCutoff())
{
  vtkOutputWindow::SetInstance(transcript_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

Listening::~Listening()
{
  vtkOutputWindow::SetInstance(before_);
  vtkLogger::SetStderrVerbosity(verbosity_before_);
}

std::string Listening::complaint() const
{
  const std::string& heard = transcript_->text();
  std::string text = heard.substr(heard.rfind("): ") == std::string::npos ? 0 : heard.rfind("): ") + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

}  // namespace luff::vtk

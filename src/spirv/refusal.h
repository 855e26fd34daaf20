// The error for a shader that cannot be executed.
#pragma once

#include <string>

#include "rainref/error.h"

namespace rainref::spirv {

/// One sentence about a module: it is not SPIR-V, it contains something that is not supported, or it did something wrong. Code port_files.
class Refusal : public Error {
 public:
  /// `module` starts the message; `at` is the line of the shader's source, if it is known.
  Refusal(const std::string& module, SourceLocation at, const std::string& sentence)
      : Error(ExitCode::port_files, module + ": " + (at.file.empty() && at.line <= 0 ? "" : text_of(at) + ": ") + sentence),
        at_(std::move(at)) {}
  /// The line of the shader's source; 0 if the module does not say.
  const SourceLocation& at() const { return at_; }

 private:
  static std::string text_of(const SourceLocation& at) { return at.file.empty() ? "line " + std::to_string(at.line) : at.text(); }
  SourceLocation at_;
};

}  // namespace rainref::spirv

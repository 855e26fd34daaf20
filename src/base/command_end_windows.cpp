#include <fmt/format.h>

#include "base/command_end.h"

namespace rainref {

std::string failure_of(const std::string& what, int status) {
  const auto code = static_cast<unsigned>(status);
  if (code == 0) return "";
  // The system's own codes: 0xC0000005 is an access violation.
  if (code >= 0x80000000u) return fmt::format("{} was ended by exception 0x{:08X}", what, code);
  return fmt::format("{} ended with exit code {}{}", what, code, code == 9009 ? ": there is no such program" : "");  // cmd.exe's number
}

}  // namespace rainref

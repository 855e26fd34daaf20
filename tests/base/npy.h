// Files of NumPy, put together by hand.
#pragma once

#include <string>

namespace rainref {

/// A file as numpy.save writes it, its type and shape as Python has them: "'<f4'", "(2, 3)".
inline std::string npy(const std::string& descr, const std::string& shape, const std::string& data) {
  std::string text = "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }";
  text.append(63 - (10 + text.size()) % 64, ' ') += '\n';
  return std::string("\x93NUMPY\1\0", 8) + static_cast<char>(text.size() & 255) + static_cast<char>(text.size() >> 8) + text + data;
}

}  // namespace rainref

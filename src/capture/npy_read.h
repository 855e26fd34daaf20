// The header of a .npy file: type, shape, and the offset of the data.
//
//   \x93NUMPY  major minor  length (2 bytes in version 1, 4 in 2 and 3)  {'descr': ..., 'fortran_order': ..., 'shape':
//   ...}
//
// Source: NumPy Enhancement Proposal 1 and the documentation of numpy.lib.format.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::capture {

/// A field of a structured array: a number, or `components` of them.
struct NpyField {
  std::string name;
  std::string type;  ///< as for NpyHeader::type
  std::size_t offset = 0;
  std::size_t components = 1;

  std::size_t bytes() const;
};

struct NpyHeader {
  std::string type;              ///< "|u1", "<f2", "<f4" or "<u4"; "" for a structured array
  std::vector<NpyField> fields;  ///< of a structured array, in order of offset, without overlap
  std::size_t record_bytes = 0;  ///< of one element, padding included
  std::vector<std::size_t> shape;
  std::size_t data_offset = 0;

  /// Product of the shape; 1 for shape (). The data have elements() * record_bytes bytes and end with the file.
  std::size_t elements() const;
};

/// Reads the header of a whole .npy file, version 1.0, 2.0 or 3.0: C order, little endian, types u1 f2 f4 u4, structured types packed,
/// padded by void fields, or given as names, formats, offsets and itemsize. `name` starts every message.
///
/// Throws Error(port_files) for any other header, if shape and type do not give exactly the number of bytes that follow, or if the file is
/// truncated. Memory use is proportional to the header, not to the shape.
NpyHeader parse_npy_header(std::span<const std::byte> file, std::string_view name);

}  // namespace rainref::capture

// NPY 1.0 files, as far as packs use them: C order, little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace port_runner {

namespace fs = std::filesystem;

/// What stops the runner; the message names the file and what was expected.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A file of the pack or of the port is missing, or is not what it should be.
struct FileError : Error {
  using Error::Error;
};

/// An option is not what it should be.
struct UsageError : Error {
  using Error::Error;
};

/// The whole file; throws FileError.
std::vector<std::uint8_t> read_file(const fs::path& file);
/// Writes under another name and renames, so that no half-written file stays; makes the folders; throws Error.
void write_file(const fs::path& file, std::string_view bytes);

struct Array {
  std::string type;                ///< the Python literal of the descr: '<f2', or a list of fields
  std::vector<std::size_t> shape;  ///< slowest first
  std::vector<std::uint8_t> bytes;
};
/// Reads a file whose type and shape must be these; throws FileError naming what was found.
std::vector<std::uint8_t> read_npy(const fs::path& file, const std::string& type, const std::vector<std::size_t>& shape);
/// Reads any NPY 1.0 file in C order; throws FileError.
Array read_npy(const fs::path& file);
void write_npy(const fs::path& file, const Array& array);

}  // namespace port_runner

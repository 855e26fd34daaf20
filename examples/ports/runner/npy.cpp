#include "ports/runner/npy.h"

#include <fstream>
#include <iterator>
#include <system_error>

namespace port_runner {
namespace {

constexpr std::string_view magic("\x93NUMPY\x01\x00", 8);

std::string tuple(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (const std::size_t side : shape) text += std::to_string(side) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  if (shape.size() == 1) text.resize(text.size() - 1);
  return text + ")";
}

// The text of a key's value, up to the comma that ends it outside of quotes and brackets.
std::string value_of(const std::string& header, const std::string& key, const fs::path& file) {
  const std::size_t at = header.find("'" + key + "':");
  if (at == std::string::npos) throw FileError(file.string() + ": the NPY header has no key '" + key + "'");
  std::size_t begin = at + key.size() + 3, end = begin;
  while (begin < header.size() && header[begin] == ' ') ++begin;
  int depth = 0;
  bool quoted = false;
  for (end = begin; end < header.size(); ++end) {
    const char c = header[end];
    if (c == '\'') quoted = !quoted;
    if (quoted) continue;
    if (c == '(' || c == '[') ++depth;
    if (depth == 0 && (c == ',' || c == '}')) break;
    if (c == ')' || c == ']') --depth;
  }
  return header.substr(begin, end - begin);
}

}  // namespace

std::vector<std::uint8_t> read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file.string() + ": cannot be read");
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw FileError(file.string() + ": reading failed");
  return bytes;
}

void write_file(const fs::path& file, std::string_view bytes) {
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  fs::path part = file;
  part += ".part";
  std::ofstream out(part, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) fs::rename(part, file, failed);
  if (!out || failed) throw Error(file.string() + ": cannot be written");
}

Array read_npy(const fs::path& file) {
  const std::vector<std::uint8_t> all = read_file(file);
  const std::string_view text(reinterpret_cast<const char*>(all.data()), all.size());
  if (all.size() < 10 || text.substr(0, magic.size()) != magic) throw FileError(file.string() + ": expected an NPY 1.0 file");
  const std::size_t length = all[8] + 256u * all[9];
  if (all.size() < 10 + length) throw FileError(file.string() + ": the NPY header is cut off");
  const std::string header(text.substr(10, length));
  if (value_of(header, "fortran_order", file) != "False") throw FileError(file.string() + ": expected C order");
  Array array;
  array.type = value_of(header, "descr", file);
  const std::string shape = value_of(header, "shape", file);
  for (std::size_t at = 1; at < shape.size() && shape[at] != ')';) {
    std::size_t used = 0;
    try {
      array.shape.push_back(std::stoull(shape.substr(at), &used));
    } catch (const std::exception&) {
      throw FileError(file.string() + ": expected a shape, found " + shape);
    }
    at = shape.find_first_not_of(", ", at + used);
  }
  array.bytes.assign(all.begin() + static_cast<std::ptrdiff_t>(10 + length), all.end());
  return array;
}

std::vector<std::uint8_t> read_npy(const fs::path& file, const std::string& type, const std::vector<std::size_t>& shape) {
  Array array = read_npy(file);
  if (array.type != type || array.shape != shape) {
    throw FileError(file.string() + ": expected " + type + " " + tuple(shape) + ", found " + array.type + " " + tuple(array.shape));
  }
  return std::move(array.bytes);
}

void write_npy(const fs::path& file, const Array& array) {
  std::string header = "{'descr': " + array.type + ", 'fortran_order': False, 'shape': " + tuple(array.shape) + ", }";
  // The data begin at a multiple of 64 bytes, after a line feed.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string all(magic);
  all += static_cast<char>(header.size() & 255);
  all += static_cast<char>(header.size() >> 8);
  all += header;
  all.append(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size());
  write_file(file, all);
}

}  // namespace port_runner

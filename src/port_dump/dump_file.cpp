#include "port_dump/dump_file.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "base/read_file.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> extensions{".npy", ".exr", ".dds", ".png", ".bin"};  // by FileType
// A folder with more names is not the dump of one pass, and each name costs a comparison.
constexpr std::size_t most_names = 1000;

struct RefusedType {
  const char* extension;
  const char* reason;
};
constexpr std::array<RefusedType, 9> refused_types{
    {{".jpg", "JPEG is lossy"},
     {".jpeg", "JPEG is lossy"},
     {".hdr", "Radiance HDR keeps 8 bits and a shared exponent of each value, and nothing below 0"},
     {".rgbe", "Radiance HDR keeps 8 bits and a shared exponent of each value, and nothing below 0"},
     {".bmp", "BMP writers change the channels (RenderDoc makes RGB of R8)"},
     {".tga", "TGA writers change the channels"},
     {".tif", "TIFF is not read"},
     {".tiff", "TIFF is not read"},
     {".ktx2", "KTX2 is not read"}}};

[[noreturn]] void refuse(const std::string& message) { throw Error(ExitCode::port_files, message); }

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end && out.size() < most_names; i.increment(error)) {
    out.push_back(path_text(i->path().filename()));
  }
  std::ranges::sort(out);
  return out;
}

[[noreturn]] void refuse_missing(const fs::path& folder, const std::string& stem) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) refuse(fmt::format("no folder '{}': the port wrote nothing of this run", path_text(folder)));
  for (const RefusedType& type : refused_types) {
    const fs::path path = folder / utf8_path(stem + type.extension);
    if (is_there(path))
      refuse(fmt::format("'{}': {}: no evidence of a buffer's values; save NPY, EXR, DDS or raw bytes", path_text(path), type.reason));
  }
  if (is_there(folder / utf8_path(stem + ".json")))
    refuse(fmt::format("'{}' describes raw bytes, but '{}.bin' is missing", path_text(folder / utf8_path(stem + ".json")), stem));
  const std::vector<std::string> names = names_in(folder);
  std::string hint;
  for (const char* extension : extensions) {
    if (hint.empty()) hint = did_you_mean(stem + extension, names);
  }
  refuse(fmt::format("'{}': no '{}' as .npy, .exr, .dds, .png or .bin with .json{}", path_text(folder), stem, hint));
}

}  // namespace

std::string DumpFile::quoted() const { return fmt::format("'{}'", path_text(path)); }

DumpFile find_dump_file(const fs::path& folder, std::string_view stem_view) {
  const std::string stem(stem_view);
  std::vector<std::string> found;
  DumpFile out;
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    const fs::path path = folder / utf8_path(stem + extensions[i]);
    if (!is_there(path)) continue;
    found.push_back(stem + extensions[i]);
    out = {path, static_cast<FileType>(i), {}};
  }
  if (found.empty()) refuse_missing(folder, stem);
  if (found.size() > 1) refuse(fmt::format("'{}': {} hold the same buffer; keep one", path_text(folder), fmt::join(found, " and ")));
  const fs::path sidecar = folder / utf8_path(stem + ".json");
  if (out.type == FileType::bin) {
    if (!is_there(sidecar)) {
      refuse(fmt::format("{}: raw bytes need '{}.json' beside them with format, width and height", out.quoted(), stem));
    }
    out.sidecar = sidecar;
  } else if (is_there(sidecar)) {
    refuse(fmt::format("'{}' describes raw bytes, but the buffer is {}; keep one", path_text(sidecar), out.quoted()));
  }
  return out;
}

std::vector<std::byte> read_port_file(const fs::path& path, std::uint64_t most) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  const char* const found = type == fs::file_type::directory   ? "a folder"
                            : type == fs::file_type::fifo      ? "a pipe"
                            : type == fs::file_type::socket    ? "a socket"
                            : type == fs::file_type::character ? "a device"
                            : type == fs::file_type::block     ? "a device"
                                                               : nullptr;
  if (found) refuse(fmt::format("'{}': expected a file, found {}", path_text(path), found));
  return read_file(path, {most, ExitCode::port_files});
}

}  // namespace rainref::port_dump

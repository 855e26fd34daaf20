// `rainref import`: a file of a debugger or an engine becomes a port's dump.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folders.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "cli/commands.h"
#include "cli/terminal.h"
#include "port_dump/import_image.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using capture::PackCase, capture::PackOutput;

/// A level of an output of a case, by its place in a pack.
struct Destination {
  const PackCase* at;
  const PackOutput* output;
  int level;
  std::string stem() const { return level == 0 ? "out." + output->name : fmt::format("out.{}.L{}", output->name, level); }
};

/// Throws Error(usage) with the nearest name.
template <class Items, class NameOf>
auto& named(const Items& items, const std::string& wanted, const std::string& what, const NameOf& name_of) {
  std::vector<std::string> names;
  for (const auto& item : items) {
    if (name_of(item) == wanted) return item;
    names.push_back(name_of(item));
  }
  throw Error(ExitCode::usage, fmt::format("--as: expected {}, found '{}'{}", what, wanted, did_you_mean(wanted, names)));
}

/// "puddle.display/0012.0/out.picture", or with ".L2" for a mip level.
Destination destination(const capture::Pack& pack, const std::string& place) {
  const std::size_t slash = place.rfind('/');
  const std::string id = place.substr(0, slash), file = slash == std::string::npos ? "" : place.substr(slash + 1);
  if (!file.starts_with("out."))
    throw Error(ExitCode::usage,
                fmt::format("--as: expected CASE/out.BUFFER, such as puddle.display/0012.0/out.picture, found '{}'", place));
  const PackCase& at = named(pack.cases, id, "a case of the pack", [](const PackCase& c) { return c.id; });
  std::string buffer = file.substr(4);
  int level = 0;
  if (const std::size_t dot = buffer.rfind(".L"); dot != std::string::npos)
    if (const std::optional<int> given = whole_from<int>(std::string_view(buffer).substr(dot + 2))) {
      level = *given;
      buffer.resize(dot);
    }
  const PackOutput& output = named(at.outputs, buffer, fmt::format("an output of {}", id), [](const PackOutput& o) { return o.name; });
  if (output.shape.is_records)
    throw Error(ExitCode::usage, fmt::format("--as: {} is a list; save it as .npy, or as .bin with .json beside it", buffer));
  if (level < 0 || level >= static_cast<int>(output.levels.size()))
    throw Error(ExitCode::usage, fmt::format("--as: expected a level below {} of {}, found {}", output.levels.size(), buffer, level));
  return {&at, &output, level};
}

/// Throws Error(port_files) for another file of this buffer, which a judgement would not tell from the new one.
void require_alone(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".exr", ".dds", ".png", ".bin", ".json"})
    if (std::error_code ignored; fs::exists(folder / utf8_path(stem + extension), ignored))
      throw Error(ExitCode::port_files,
                  fmt::format("'{}' holds the same buffer; remove it first", path_text(folder / utf8_path(stem + extension))));
}

}  // namespace

int import_file(const ImportRequest& request) {
  const capture::Pack pack(request.pack);
  const Destination to = destination(pack, request.as);
  const capture::Array expected = pack.read(*to.output);
  const fs::path folder = request.output / utf8_path(to.at->id);
  require_alone(folder, to.stem());
  const port_dump::Origin own = port_dump::read_port_info(request.output).origin;
  port_dump::ImportedLevel taken = port_dump::import_level(request.file, expected, to.level, request.hints);
  capture::Array made = expected;
  made.width = expected.level_width(to.level);
  made.height = expected.level_height(to.level);
  if (own == port_dump::Origin::bottom_left) taken.bytes = port_dump::turned_over(taken.bytes, static_cast<std::size_t>(made.height));
  made.levels = {std::move(taken.bytes)};
  MadeFolders parents(folder);
  const fs::path path = folder / utf8_path(to.stem() + ".npy");
  write_file(path, capture::npy_bytes(made, 0));
  parents.keep();
  for (const std::string& line : taken.said) say("{}\n", line);
  say("{} {}x{} in {}\n", info(made.format).name, made.width, made.height, path_text(path));
  return 0;
}

}  // namespace rainref::cli

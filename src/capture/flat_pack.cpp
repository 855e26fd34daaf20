#include "capture/flat_pack.h"

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "capture/manifest_write.h"
#include "capture/new_folder.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// Explains why the folder may not be replaced, or returns "".
std::string may_replace_flat(const fs::path& folder) {
  if (!fs::is_regular_file(folder / flat_name)) return "the folder is not empty and no flat pack of rainref";
  for (const fs::directory_entry& e : fs::recursive_directory_iterator(folder))
    if (!e.is_directory() && e.path() != folder / flat_name && e.path().extension() != ".bin")
      return fmt::format("the flat pack there would be replaced, but '{}' is no part of it", path_text(e.path().filename()));
  return "";
}

/// Files of a flat pack, each content of the pack once.
class FlatFiles {
 public:
  explicit FlatFiles(const fs::path& folder) : folder_(folder, may_replace_flat) {}
  /// The file for bytes that the pack holds in `source`, written under `path` where they are new.
  template <class Read>
  Json add(const std::string& source, const std::string& path, const Read& read) {
    const auto [found, is_new] = written_.try_emplace(source);
    if (is_new) {
      const std::vector<std::byte> bytes = read();
      write(path, bytes);
      found->second = {{"file", path}, {"bytes", bytes.size()}};
    }
    return found->second;
  }
  PackWriter::Total finish(const Json& flat) {
    const std::string text = manifest_text(flat);
    write(flat_name, std::as_bytes(std::span(text)));
    folder_.commit();
    total_.cases = static_cast<int>(flat["cases"].size());
    return total_;
  }

 private:
  void write(const std::string& path, std::span<const std::byte> bytes) {
    folder_.write(path, bytes);
    ++total_.files;
    total_.bytes += bytes.size();
  }

  NewFolder folder_;
  std::map<std::string, Json> written_;  // by the files of the pack
  PackWriter::Total total_;
};

Json shape_json(const Array& array) {
  if (array.is_records)
    return {{"format", "records"}, {"record", array.record.name}, {"count", array.width}, {"struct_stride", array.record.size}};
  return {{"format", info(array.format).name}, {"width", array.width}, {"height", array.height}};
}

Json input_json(const Pack& pack, const std::string& folder, const PackInput& input, FlatFiles& files) {
  std::string source;
  for (const PackFileEntry& level : input.levels) source += level.path + '\n';
  const Json file = files.add(source, fmt::format("{}/in.{}.bin", folder, input.name), [&] {
    std::vector<std::byte> bytes;
    const Array array = pack.read(input);
    for (const std::vector<std::byte>& level : array.levels) bytes.insert(bytes.end(), level.begin(), level.end());
    return bytes;
  });
  Json out{{"name", input.name}};
  out.update(file);
  out.update(shape_json(input.shape));
  if (input.shape.is_records) return out;
  const CaseInput& rules = input.rules;
  out.update({{"levels", input.levels.size()},
              {"filter", name(rules.filter)},
              {"mip_filter", name(rules.mip_filter)},
              {"address_u", name(rules.address_u)},
              {"address_v", name(rules.address_v)}});
  if (rules.address_u == Address::border || rules.address_v == Address::border) out["border"] = rules.border;
  return out;
}

/// One entry for each level, because each is a file of its own in a dump.
void add_outputs(const std::string& folder, const PackOutput& output, Json& to) {
  for (std::size_t level = 0; level < output.levels.size(); ++level) {
    Json one{{"name", output.name}};
    one["file"] =
        level == 0 ? fmt::format("{}/out.{}.bin", folder, output.name) : fmt::format("{}/out.{}.L{}.bin", folder, output.name, level);
    Array shape = output.shape;
    if (!shape.is_records) {
      shape.height = output.shape.level_height(static_cast<int>(level));
      shape.width = output.shape.level_width(static_cast<int>(level));
    }
    one.update(shape_json(shape));
    one.erase("count");  // the port finds how many there are
    to.push_back(std::move(one));
  }
}

}  // namespace

PackWriter::Total write_flat(const Pack& pack, const fs::path& folder) {
  if (!pack.with_inputs)
    throw Error(ExitCode::usage,
                fmt::format("{}: a capture without inputs has nothing for a port to read; make a pack", path_text(pack.folder())));
  FlatFiles files(folder);
  Json flat{{"format", "rainref.flat"}, {"version", 1}, {"effect", pack.effect}, {"variant", pack.variant}};
  flat["cases"] = Json::array();
  for (const PackCase& c : pack.cases) {
    Json one{{"id", c.id}, {"pass", c.pass}, {"frame", c.frame}, {"step", c.step}};
    if (c.level >= 0) one["level"] = c.level;
    one["uniforms"] = files.add(c.uniforms.path, c.id + "/uniforms.bin", [&] { return pack.read_file(c.uniforms); });
    one["inputs"] = Json::array();
    one["outputs"] = Json::array();
    for (const PackInput& input : c.inputs) one["inputs"].push_back(input_json(pack, c.id, input, files));
    for (const PackOutput& output : c.outputs) add_outputs(c.id, output, one["outputs"]);
    flat["cases"].push_back(std::move(one));
  }
  return files.finish(flat);
}

}  // namespace rainref::capture

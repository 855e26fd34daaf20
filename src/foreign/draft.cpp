#include "foreign/draft.h"

#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "capture/manifest_write.h"
#include "foreign/effect_file.h"
#include "scene/json.h"
#include "spirv/interface.h"

namespace rainref::foreign {
namespace {

using nlohmann::ordered_json;
using spirv::Bound, spirv::Wanted;

constexpr const char* unknown = "?";

ordered_json place_of(const Wanted& w) { return {{"name", w.name}, {"set", w.set}, {"binding", w.binding}, {"sentence", ""}}; }
ordered_json image_of(const Wanted& w) {
  ordered_json out = place_of(w);
  out["from"] = unknown;
  out["run"] = "this";
  for (const char* key : {"format", "width", "height"}) out[key] = unknown;
  out["levels"] = 1;
  for (const char* key : {"address_u", "address_v", "filter"}) out[key] = unknown;
  out["mip_filter"] = "none";
  return out;
}
ordered_json list_of(const Wanted& w) {
  ordered_json out = place_of(w);
  out["from"] = "host";
  out["format"] = "records";
  out["record"] = scene::uniform_block_json(w.block);
  return out;
}
ordered_json output_of(const Wanted& w) {
  ordered_json out = place_of(w);
  out["format"] = w.format ? std::string(info(*w.format).name) : unknown;
  for (const char* key : {"width", "height"}) out[key] = unknown;
  out["range"] = {0, 1};
  out["unit"] = "1";
  return out;
}

ordered_json pass_of(const std::filesystem::path& shader) {
  spirv::Program program;
  program.spirv = shader;
  const spirv::Module module(spirv::read_spirv(program), "'" + path_text(shader) + "'");
  ordered_json out{{"name", path_text(shader.stem())}, {"sentence", ""}, {"spirv", path_text(shader.filename())}};
  ordered_json inputs = ordered_json::array(), outputs = ordered_json::array();
  for (const Wanted& w : spirv::interface_of(module)) {
    if (w.bound == Bound::uniform_buffer) out["uniform_block"] = scene::uniform_block_json(w.block);
    if (w.bound == Bound::sampled_image) inputs.push_back(image_of(w));
    if (w.bound == Bound::storage_buffer) inputs.push_back(list_of(w));
    if (w.bound == Bound::storage_image) outputs.push_back(output_of(w));
  }
  out["inputs"] = std::move(inputs);
  out["outputs"] = std::move(outputs);
  return out;
}

}  // namespace

std::string draft_of(const std::vector<std::filesystem::path>& shaders) {
  ordered_json out{{"format", file_format}, {"version", 1}, {"effect", unknown}, {"passes", ordered_json::array()}};
  for (const std::filesystem::path& shader : shaders) out["passes"].push_back(pass_of(shader));
  constexpr int deep_enough_to_edit = 8;
  return capture::manifest_text(out, deep_enough_to_edit);
}

}  // namespace rainref::foreign

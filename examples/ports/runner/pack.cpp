#include "ports/runner/pack.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "ports/runner/json_file.h"

namespace port_runner {
namespace {

using nlohmann::json;

const std::map<std::string, Format> formats{{"r8", {VK_FORMAT_R8_UNORM, "'|u1'", 1, 1}},
                                            {"rg8", {VK_FORMAT_R8G8_UNORM, "'|u1'", 2, 2}},
                                            {"rgba8", {VK_FORMAT_R8G8B8A8_UNORM, "'|u1'", 4, 4}},
                                            {"rgba8_srgb", {VK_FORMAT_R8G8B8A8_SRGB, "'|u1'", 4, 4}},
                                            {"r16f", {VK_FORMAT_R16_SFLOAT, "'<f2'", 1, 2}},
                                            {"rg16f", {VK_FORMAT_R16G16_SFLOAT, "'<f2'", 2, 4}},
                                            {"rgba16f", {VK_FORMAT_R16G16B16A16_SFLOAT, "'<f2'", 4, 8}},
                                            {"r32f", {VK_FORMAT_R32_SFLOAT, "'<f4'", 1, 4}},
                                            {"rg32f", {VK_FORMAT_R32G32_SFLOAT, "'<f4'", 2, 8}},
                                            {"rgba32f", {VK_FORMAT_R32G32B32A32_SFLOAT, "'<f4'", 4, 16}},
                                            {"r32ui", {VK_FORMAT_R32_UINT, "'<u4'", 1, 4}}};

// The NPY type of a record: its fields one after the other, as the manifest declares them; gaps have no name.
std::string record_type(const json& record) {
  std::string type = "[";
  std::size_t end = 0;
  const auto gap = [&](std::size_t to) {
    if (to > end) type += std::string(type.size() > 1 ? ", " : "") + "('', '|V" + std::to_string(to - end) + "')";
  };
  for (const json& member : record.at("members")) {
    const std::string scalar = member.at("type");
    gap(member.at("offset"));
    end = member.at("offset").get<std::size_t>() + 4 * member.at("components").get<std::size_t>();
    type += std::string(type.size() > 1 ? ", " : "") + "('" + member.at("name").get<std::string>() + "', " +
            (scalar == "float" ? "'<f4'"
             : scalar == "int" ? "'<i4'"
                               : "'<u4'");
    const int components = member.at("components");
    type += components > 1 ? ", (" + std::to_string(components) + ",))" : ")";
  }
  gap(record.at("size"));
  return type + "]";
}

Buffer read_buffer(const json& from, const json& records) {
  Buffer b;
  b.name = from.at("name");
  b.file = from.at("file");
  const std::string format = from.at("format");
  if (format == "records") {
    b.is_records = true;
    b.count = from.at("count");
    const auto record = std::find_if(records.begin(), records.end(), [&](const json& r) { return r.at("name") == from.at("record"); });
    if (record == records.end()) throw FileError("buffer " + b.name + ": no such record: " + from.at("record").get<std::string>());
    b.record_bytes = record->at("size");
    b.record_type = record_type(*record);
    return b;
  }
  const auto known = formats.find(format);
  if (known == formats.end()) throw FileError("buffer " + b.name + ": unknown format " + format);
  b.format = known->second;
  b.levels.push_back({from.at("width"), from.at("height"), b.file});
  for (const json& mip : from.value("mips", json::array())) b.levels.push_back({mip.at("width"), mip.at("height"), mip.at("file")});
  b.address_u = from.value("address_u", "clamp");
  b.address_v = from.value("address_v", "clamp");
  b.filter = from.value("mag_filter", "none");
  b.mip_filter = from.value("mip_filter", "none");
  if (const auto border = from.find("border"); border != from.end() && border->is_array()) b.border = border->get<std::vector<float>>();
  return b;
}

Case read_case(const json& from, const json& manifest) {
  Case c;
  c.id = from.at("id");
  c.pass = from.at("pass");
  for (const json& pass : manifest.at("passes")) {
    if (pass.at("name") != c.pass) continue;
    c.formula = pass.at("formula");
    c.reads = pass.at("reads");
    c.writes = pass.at("writes");
  }
  c.uniform_file = from.at("uniform_block").at("file");
  c.uniform_bytes = from.at("uniform_block").at("bytes");
  const json records = manifest.value("records", json::array());
  for (const json& input : from.at("inputs")) c.inputs.push_back(read_buffer(input, records));
  for (const json& output : from.at("outputs")) c.outputs.push_back(read_buffer(output, records));
  return c;
}

}  // namespace

Pack read_pack(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  const json manifest = parse_json(file);
  try {
    if (manifest.at("format") != "rainref.pack") throw FileError("format: expected rainref.pack");
    if (manifest.at("version") > 1) throw FileError("version: this runner knows version 1, the pack has " + manifest.at("version").dump());
    Pack pack{folder, {}};
    for (const json& c : manifest.at("cases")) pack.cases.push_back(read_case(c, manifest));
    return pack;
  } catch (const json::exception& e) {
    throw FileError(file.string() + ": " + reason(e));
  } catch (const FileError& e) {
    throw FileError(file.string() + ": " + e.what());
  }
}

}  // namespace port_runner

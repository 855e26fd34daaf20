#include "capture/pack_write.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/manifest_write.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"

namespace rainref::capture {
namespace {

// Explains why the folder may not be replaced by a new pack, or returns "".
std::string may_replace(const std::filesystem::path& folder) {
  try {
    const std::string spare = Pack(folder).file_beside();
    return spare.empty() ? "" : fmt::format("the pack there would be replaced, but '{}' is no part of it", spare);
  } catch (const Error&) {
    return "the folder is not empty and no pack of rainref";
  }
}

}  // namespace

struct PackWriter::State {
  const EffectInfo& effect;
  std::string variant;
  NewFolder folder;
  nlohmann::ordered_json manifest;
  std::map<Hash128, PackFile> written;  // by content: header and data
  Total total;

  PackFile write(std::string path, std::span<const std::byte> bytes, bool may_share) {
    const Hash128 hash = file_hash(bytes);
    if (may_share) {
      if (const auto found = written.find(hash); found != written.end()) return found->second;
    }
    folder.write(path, bytes);
    ++total.files;
    total.bytes += bytes.size();
    PackFile file{std::move(path), bytes.size(), hash};
    written.emplace(hash, file);
    return file;
  }
  std::vector<PackFile> write(const std::string& stem, const Array& array, bool may_share) {
    std::vector<PackFile> files;
    for (std::size_t level = 0; level < array.levels.size(); ++level) {
      const std::string name = level == 0 ? stem + ".npy" : fmt::format("{}.L{}.npy", stem, level);
      files.push_back(write(name, npy_bytes(array, static_cast<int>(level)), may_share));
    }
    return files;
  }
};

PackWriter::PackWriter(std::filesystem::path folder, const EffectInfo& effect, const scene::Config& config, const std::string& scene_name,
                       bool with_inputs, const std::vector<std::string>& passes)
    : state_(new State{effect,
                       config.variant(),
                       {std::move(folder), may_replace},
                       manifest_head(effect, config, scene_name, with_inputs, passes),
                       {},
                       {}}) {}
PackWriter::~PackWriter() = default;

void PackWriter::add(const PassCase& c) {
  State& s = *state_;
  const std::string folder = c.folder();
  const PassInfo& pass = s.effect.pass(c.pass);
  nlohmann::ordered_json json = case_json(c, s.effect, s.write(folder + "/uniforms.bin", c.uniforms, true));
  json["inputs"] = json["outputs"] = nlohmann::ordered_json::array();
  for (const CaseInput& input : c.inputs) {
    json["inputs"].push_back(
        input_json(input, s.effect.buffer(input.name, s.variant), s.write(fmt::format("{}/in.{}", folder, input.name), input.array, true)));
  }
  for (const CaseOutput& output : c.outputs) {
    json["outputs"].push_back(output_json(output, s.effect.buffer(output.name, s.variant), pass,
                                          s.write(fmt::format("{}/out.{}", folder, output.name), output.array, false)));
  }
  s.manifest["cases"].push_back(std::move(json));
  ++s.total.cases;
}

void PackWriter::add_reference(const std::string& path, std::span<const std::byte> bytes) {
  nlohmann::ordered_json file;
  put_file(file, state_->write(path, bytes, false));
  state_->manifest["reference"].push_back(std::move(file));
}

void PackWriter::add_coverage(const std::string& pass, int exercised, int alternatives, const std::vector<std::string>& never,
                              const std::map<std::string, std::string>& reasons, bool is_sampled) {
  for (nlohmann::ordered_json& p : state_->manifest["passes"]) {
    if (p["name"] != pass) continue;
    p["coverage"] = {{"exercised", exercised}, {"alternatives", alternatives}, {"never", never}, {"reasons", reasons}};
    if (is_sampled) p["coverage"]["sampled"] = true;
  }
}

PackWriter::Total PackWriter::finish() {
  State& s = *state_;
  const std::string text = manifest_text(s.manifest);
  s.folder.write(manifest_name, std::as_bytes(std::span(text)));
  ++s.total.files;
  s.total.bytes += text.size();
  s.folder.commit();
  return s.total;
}

}  // namespace rainref::capture

// Writes a pack's manifest in parts. docs/packs.md documents the keys.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/hash.h"
#include "capture/pass_case.h"
#include "capture/pass_info.h"
#include "scene/config.h"

namespace rainref::capture {

inline constexpr const char* pack_format = "rainref.pack";
inline constexpr int pack_version = 1;
inline constexpr char manifest_name[] = "manifest.json";

/// A file of a pack: its path relative to the pack's folder, with slashes.
struct PackFile {
  std::string path;
  std::size_t bytes;
  Hash128 hash;
};

/// Adds the keys for a file's path and contents.
void put_file(nlohmann::ordered_json& to, const PackFile& file);
/// Everything but `cases`: format, versions, configuration, conventions, graph, and these passes of the effect.
nlohmann::ordered_json manifest_head(const EffectInfo& effect, const scene::Config& config, const std::string& scene_name, bool with_inputs,
                                     const std::vector<std::string>& passes);
/// A case without its inputs and outputs.
nlohmann::ordered_json case_json(const PassCase& c, const EffectInfo& effect, const PackFile& uniforms);
/// One file for each level.
nlohmann::ordered_json input_json(const CaseInput& input, const BufferInfo& buffer, const std::vector<PackFile>& files);
nlohmann::ordered_json output_json(const CaseOutput& output, const BufferInfo& buffer, const PassInfo& pass,
                                   const std::vector<PackFile>& files);

/// Indented to this depth. Short values are on one line, and so is each input and output of a case in a manifest.
std::string manifest_text(const nlohmann::ordered_json& manifest, int deepest = 4);

}  // namespace rainref::capture

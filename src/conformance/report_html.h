// A judgement as one page for the eye: no network, no other file, light and dark, keyboard and mouse.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "conformance/report_pictures.h"
#include "conformance/verdict.h"

namespace rainref::conformance {

/// One output of one case with its values.
struct OutputBuffers {
  capture::Array expected, port;
  Meaning meaning;
};

/// What the page shows beside the judgement.
struct PageSource {
  std::vector<capture::PackEdge> edges;
  std::map<std::string, std::string> sentences;  ///< of passes, by name
  /// Reads an output of a case again; nothing where it cannot be had. Null: no pictures.
  std::function<std::optional<OutputBuffers>(const std::string& id, const std::string& output)> read;
};
/// That of a pack and a port's folder, which must outlive it.
PageSource page_source(const capture::Pack& pack, const std::filesystem::path& port);

/// Pictures stop when they come to this many bytes of PNG, those of failing passes first; the page says what is left out.
inline constexpr std::size_t picture_budget = std::size_t{32} << 20;
/// Of a pass at most this many failing cases get pictures, the first and those with most failures; and one that passes.
inline constexpr std::size_t pictured_failures = 4;

/// The whole page.
std::string report_html(const PortJudgement& judgement, const PageSource& source);

}  // namespace rainref::conformance

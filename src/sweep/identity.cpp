#include "sweep/identity.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/path_text.h"
#include "base/hash_of_file.h"
#include "base/read_file.h"
#include "effect/inputs.h"
#include "effect/picture_sequence.h"
#include "rainref/error.h"
#include "scene/value_text.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;

/// Equal bit for bit.
bool is_same(const scene::Value& a, const scene::Value& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&]<class T>(const T& x) {
        const T& y = *std::get_if<T>(&b);
        if constexpr (std::is_same_v<T, std::string>)
          return x == y;
        else
          return std::memcmp(&x, &y, sizeof(T)) == 0;
      },
      a);
}

}  // namespace

bool has(const scene::Config& config, std::string_view key) {
  const auto& all = config.entries();
  return std::any_of(all.begin(), all.end(), [&](const scene::Config::Entry& e) { return e.parameter.key == key; });
}

std::string id_of(std::string_view text) { return file_hash(std::as_bytes(std::span(text))).text(); }

std::string Inputs::hash_of(const scene::Config& config, const std::string& key) {
  const effect::NamedFile named(config, key);
  const fs::path path = named.path_of(named.name);
  std::string name = path_text(fs::absolute(path).lexically_normal());
  const bool is_sequence = effect::is_sequence(named.name) && has(config, "sequence.first");
  if (is_sequence)
    name += fmt::format(" {} {} {}", config.integer("sequence.first"), config.integer("sequence.count"), config.integer("run.frames"));
  // If a file has several channels, the one that another key reads.
  if (effect::content_of(key) != image_io::Content::colour) name += " " + key;
  std::string& hash = known_[name];
  if (!hash.empty()) return hash;
  if (is_sequence) {
    effect::Inputs found;
    const effect::PictureSource source(config, key, found);
    for (const effect::InputFile& f : found.files) hash += fmt::format("{} {} {} ", f.hash, f.first, f.count);
  } else if (key.ends_with("drive_cycle") || effect::is_film(named.name)) {
    try {
      hash = hash_of_file(path, {UINT64_MAX, ExitCode::io}).text();
    } catch (const Error& e) {
      throw named.placed(e.code(), e.what());
    }
  } else {
    hash = effect::read_picture(named, named.name).decoded_hash.text();
  }
  return hash;
}

std::string Inputs::text_of(const scene::Config& config) {
  const std::vector<scene::Config::Entry>& entries = config.entries();
  const auto is_line = [](const scene::Config::Entry& e, const Line& line) { return e.parameter.key == line.key; };
  const bool is_like_before =
      directory_ == config.directory() && std::equal(entries.begin(), entries.end(), lines_.begin(), lines_.end(), is_line);
  // The meaning of a name depends on the folder, and for a sequence on further keys.
  bool is_same_sequence = is_like_before;
  for (std::size_t i = 0; i < entries.size() && is_same_sequence; ++i)
    is_same_sequence =
        is_same(lines_[i].value, entries[i].value) || !(lines_[i].key == "run.frames" || lines_[i].key.starts_with("sequence."));
  if (!is_like_before) lines_.assign(entries.size(), {});
  directory_ = config.directory();
  std::string out;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const scene::Config::Entry& e = entries[i];
    Line& line = lines_[i];
    if (line.text.empty() || !is_same(line.value, e.value) || (line.is_of_file && !is_same_sequence)) {
      const std::string& key = e.parameter.key;
      const auto* text = std::get_if<std::string>(&e.value);
      line = {key, e.value, "", text && !text->empty() && e.parameter.type == scene::Type::text && effect::names_files(key)};
      line.text = line.is_of_file ? fmt::format("{} holds {}\n", key, hash_of(config, key))
                                  : fmt::format("{} = {}\n", key, scene::value_text(e.value));
    }
    if (line.key != "run.frames") out += line.text;
  }
  return out;
}

std::string Inputs::bytes_hash(const fs::path& file) {
  std::string& hash = known_[path_text(fs::absolute(file).lexically_normal()) + "/bytes"];
  if (hash.empty()) hash = file_hash(read_file(file)).text();
  return hash;
}

std::string Inputs::folder_hash(const fs::path& folder) {
  std::string& hash = known_[path_text(folder) + "/"];
  if (!hash.empty()) return hash;
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
    if (i->is_regular_file()) files.push_back(i->path());
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot be read: {}", path_text(folder), error.message()));
  std::sort(files.begin(), files.end());
  std::string all;
  for (const fs::path& file : files)
    all += fmt::format("{} {}\n", path_text(fs::relative(file, folder)), file_hash(read_file(file)).text());
  return hash = id_of(all);
}

}  // namespace rainref::sweep

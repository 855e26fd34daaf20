#include "effect/inputs.h"

#include <fmt/format.h>

#include "effect/npy_picture.h"
#include "rainref/error.h"
#include "scene/check.h"

namespace rainref::effect {

NamedFile::NamedFile(const scene::Config& config, const std::string& of)
    : key(of), name(config.text(of)), origin(config.entry(of).origin), directory(config.directory()) {}

std::filesystem::path NamedFile::path_of(const std::string& file) const {
  const std::filesystem::path path = file;
  return path.is_relative() && origin.kind == scene::Origin::file ? directory / path : path;
}
Error NamedFile::placed(ExitCode code, const std::string& message) const {
  if (origin.kind == scene::Origin::file) return Error(code, origin.at, fmt::format("{}: {}", key, message));
  return Error(code, fmt::format("--set {}: {}", key, message));
}

image_io::Picture read_picture(const NamedFile& named, const std::string& file) {
  const std::filesystem::path path = named.path_of(file);
  try {
    return is_npy(path) ? read_npy(path) : image_io::read(path);
  } catch (const Error& e) {
    throw named.placed(e.code(), e.what());
  }
}
image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs) {
  const NamedFile named(config, key);
  image_io::Picture picture = read_picture(named, named.name);
  inputs.files.push_back({key, named.name, picture.decoded_hash.text(), picture.lossy});
  return picture;
}

void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why) {
  if (config.text(key).empty()) return;
  scene::refuse(
      config.entry(key).origin, key,
      fmt::format("expected none where {} is \"{}\", which does not use it, found '{}'", why, config.text(why), config.text(key)));
}

}  // namespace rainref::effect

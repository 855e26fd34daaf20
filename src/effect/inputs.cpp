#include "effect/inputs.h"

#include <fmt/format.h>

#include "effect/npy_picture.h"
#include "rainref/error.h"
#include "scene/check.h"

namespace rainref::effect {

image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs) {
  std::filesystem::path path = config.text(key);
  const auto& origin = config.entry(key).origin;
  if (path.is_relative() && origin.kind == scene::Origin::file) path = config.directory() / path;
  image_io::Picture picture;
  try {
    picture = is_npy(path) ? read_npy(path) : image_io::read(path);
  } catch (const Error& e) {
    if (origin.kind == scene::Origin::file) throw Error(e.code(), origin.at, fmt::format("{}: {}", key, e.what()));
    throw Error(e.code(), fmt::format("--set {}: {}", key, e.what()));
  }
  inputs.files.push_back({key, config.text(key), picture.decoded_hash.text(), picture.lossy});
  return picture;
}

void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why) {
  if (config.text(key).empty()) return;
  scene::refuse(
      config.entry(key).origin, key,
      fmt::format("expected none where {} is \"{}\", which does not use it, found '{}'", why, config.text(why), config.text(key)));
}

}  // namespace rainref::effect

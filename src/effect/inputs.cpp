#include "effect/inputs.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "cache/prepared.h"
#include "effect/film_reader.h"
#include "effect/npy_picture.h"
#include "scene/check.h"

namespace rainref::effect {

bool names_files(std::string_view key) {
  const std::string_view last = key.substr(key.rfind('.') + 1);
  return last.ends_with("image") || last == "panorama" || last == "drive_cycle";
}

image_io::Content content_of(std::string_view key) {
  const std::string_view last = key.substr(key.rfind('.') + 1);
  if (last == "depth_image") return image_io::Content::depth;
  const bool is_quantity = last == "layer_image" || last == "noise_image" || last == "shelter_image";
  return is_quantity ? image_io::Content::quantity : image_io::Content::colour;
}

NamedFile::NamedFile(const scene::Config& config, const std::string& of)
    : key(of), name(config.text(of)), origin(config.entry(of).origin), directory(config.directory()) {}

std::filesystem::path NamedFile::path_of(const std::string& file) const {
  const std::filesystem::path path = utf8_path(file);
  if (path.is_absolute()) return path;
  if (origin.kind == scene::Origin::file) return directory / path;
  return utf8_path(origin.at.file).parent_path() / path;  // of a preset; --set has no file
}
Error NamedFile::placed(ExitCode code, const std::string& message) const {
  if (origin.kind == scene::Origin::file || !origin.at.file.empty()) return Error(code, origin.at, fmt::format("{}: {}", key, message));
  return Error(code, fmt::format("--set {}: {}", key, message));
}

namespace {

/// A copy that shares the texels.
image_io::Picture copy_of(const image_io::Picture& p) {
  return {p.image.shared(), p.channel_names, p.srgb_encoded, p.lossy, p.compression,
          p.decoded_hash,   p.file_width,    p.file_height,  p.taken, p.remarks};
}

struct Decoded {
  image_io::Picture picture;
  std::size_t bytes() const { return cache::bytes_of(picture.image); }
};
Decoded decode(const int&, const std::string& path, const Hash128& /*of its bytes*/, const image_io::Content& content) {
  const std::filesystem::path file = utf8_path(path);
  Decoded made{is_npy(file) ? read_npy(file, content) : image_io::read(file, {}, content)};
  made.picture.image.share();
  return made;
}

}  // namespace

image_io::Picture read_picture(const NamedFile& named, const std::string& file) {
  const std::filesystem::path path = named.path_of(file);
  const image_io::Content content = content_of(named.key);
  if (is_film(file))
    throw named.placed(ExitCode::usage, fmt::format("expected a picture, found the film '{}'; scene.image takes films", file));
  try {
    std::error_code error;
    if (!cache::remembers() || !std::filesystem::is_regular_file(path, error)) return decode(0, path_text(path), {}, content).picture;
    return copy_of(cache::prepared("picture", 0, decode, path_text(path), file_hash(read_file(path)), content)->picture);
  } catch (const Error& e) {
    throw named.placed(e.code(), e.what());
  }
}
image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs) {
  const NamedFile named(config, key);
  image_io::Picture picture = read_picture(named, named.name);
  add_input(named, picture, {key, named.name, picture.decoded_hash.text(), picture.lossy}, inputs);
  return picture;
}
void add_input(const NamedFile& named, const image_io::Picture& picture, InputFile file, Inputs& inputs) {
  file.channel = picture.taken;
  for (const std::string& remark : picture.remarks) inputs.notes.push_back(fmt::format("{}: '{}': {}", named.key, file.path, remark));
  inputs.files.push_back(std::move(file));
}

std::shared_ptr<const scene::Scenery> street_of(const Inputs& inputs, const scene::SceneryOptions& options) {
  if (!inputs.street) throw Error(ExitCode::usage, "scene: expected pictures of what is seen, found none, and no street in their place");
  return inputs.street(options);
}

void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why) {
  if (config.text(key).empty()) return;
  scene::refuse(
      config.entry(key).origin, key,
      fmt::format("expected none where {} is \"{}\", which does not use it, found '{}'", why, config.text(why), config.text(key)));
}

}  // namespace rainref::effect

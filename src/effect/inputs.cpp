#include "effect/inputs.h"

#include <sys/stat.h>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "cache/remembered.h"
#include "effect/npy_picture.h"
#include "image/flipped.h"
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
  const std::filesystem::path path = file;
  return path.is_relative() && origin.kind == scene::Origin::file ? directory / path : path;
}
Error NamedFile::placed(ExitCode code, const std::string& message) const {
  if (origin.kind == scene::Origin::file || !origin.at.file.empty()) return Error(code, origin.at, fmt::format("{}: {}", key, message));
  return Error(code, fmt::format("--set {}: {}", key, message));
}

namespace {

/// Which file this is, as it stands there now; "" where nobody can say.
std::string stand_of(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return {};
  return fmt::format("{} {} {} {}.{}", found.st_dev, found.st_ino, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec);
}

image_io::Picture copy_of(const image_io::Picture& p) {
  return {rainref::copy_of(p.image),
          p.channel_names,
          p.srgb_encoded,
          p.lossy,
          p.compression,
          p.decoded_hash,
          p.file_width,
          p.file_height,
          p.taken,
          p.remarks};
}

}  // namespace

image_io::Picture read_picture(const NamedFile& named, const std::string& file) {
  static cache::Remembered<image_io::Picture>& remembered = *new cache::Remembered<image_io::Picture>;
  const std::filesystem::path path = named.path_of(file);
  const image_io::Content content = content_of(named.key);
  try {
    std::string stand = cache::remembered_bytes() > 0 ? stand_of(path) : "";
    if (!stand.empty()) stand += fmt::format(" {}", static_cast<int>(content));
    if (const auto known = remembered.find(stand)) return copy_of(*known);
    image_io::Picture picture = is_npy(path) ? read_npy(path, content) : image_io::read(path, {}, content);
    const Image& image = picture.image;
    if (!stand.empty()) {
      remembered.keep(stand, std::make_shared<image_io::Picture>(copy_of(picture)),
                      Image::memory_bytes(image.format(), image.width(), image.height()));
    }
    return picture;
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

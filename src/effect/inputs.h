// The files that a scene names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "image_io/read.h"
#include "rainref/error.h"
#include "scene/config.h"
#include "scene/scenery.h"

namespace rainref::effect {

/// A file that a scene named, as it was decoded; or a sequence of them, of whose bytes the hash is.
struct InputFile {
  std::string key, path, hash;
  bool lossy;
  std::int64_t first = 0, count = 0;  ///< of a sequence: the number of the first file, and how many there are; 0: a single file
  std::string channel = {};           ///< of one quantity: the file's channel that was taken
};
/// All of them, and a sentence each about what is doubtful about them, and about what was chosen in reading them.
struct Inputs {
  std::vector<InputFile> files;
  std::vector<std::string> warnings, notes;
  scene::MakeScenery street = nullptr;  ///< makes what is seen where the scene names no picture: whoever opens a scene chooses it
};
/// That street. Throws Error(usage) where there is none.
std::shared_ptr<const scene::Scenery> street_of(const Inputs& inputs, const scene::SceneryOptions& options);

/// Whether the value of this key names files: its last part ends in "image", or is "panorama" or "drive_cycle".
bool names_files(std::string_view key);

/// What the picture files of a key are read for.
image_io::Content content_of(std::string_view key);

/// A key whose value names files: what reading one of them takes of the scene.
struct NamedFile {
  std::string key, name;
  scene::Origin origin;
  std::filesystem::path directory;

  NamedFile(const scene::Config& config, const std::string& key);
  /// Where a file lies that the scene calls so: one that the scene names lies beside the scene, one from the command line where the user
  /// stands.
  std::filesystem::path path_of(const std::string& file) const;
  /// The error with place and key before its message.
  Error placed(ExitCode code, const std::string& message) const;
};

/// Reads the picture that `key` names, NPY or what image_io::read takes, and adds it to `inputs`. Throws Error
/// naming the key where it cannot be read.
image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs);
/// A picture file of that key, decoded.
image_io::Picture read_picture(const NamedFile& named, const std::string& file);
/// Adds the file, or the sequence of them that `file` says, with what was chosen in reading it.
void add_input(const NamedFile& named, const image_io::Picture& picture, InputFile file, Inputs& inputs);

/// Throws Error(usage) where `key` names a file although the value of the key `why` leaves no use for it.
void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why);

}  // namespace rainref::effect

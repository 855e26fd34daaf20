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

/// A decoded file that a scene names, or a sequence of files; the hash is of all their bytes.
struct InputFile {
  std::string key, path, hash;
  bool lossy;
  std::int64_t first = 0, count = 0;  ///< for a sequence: number of the first file, and number of files; 0: a single file
  std::string channel = {};           ///< for a single quantity: the channel of the file that was read
};
/// All input files. Sentences about doubtful properties, and about choices made in reading them.
struct Inputs {
  std::vector<InputFile> files;
  std::vector<std::string> warnings, notes;
  scene::MakeScenery street = nullptr;  ///< makes the scene if no picture is named; set by the function that opens a scene
};
/// Returns that street. Throws Error(usage) if there is none.
std::shared_ptr<const scene::Scenery> street_of(const Inputs& inputs, const scene::SceneryOptions& options);

/// True if the value of this key names files: its last part ends in "image", or is "panorama" or "drive_cycle".
bool names_files(std::string_view key);

/// The kind of content of this key's picture files.
image_io::Content content_of(std::string_view key);

/// A key whose value names files, with the parts of the scene needed to read one of them.
struct NamedFile {
  std::string key, name;
  scene::Origin origin;
  std::filesystem::path directory;

  NamedFile(const scene::Config& config, const std::string& key);
  /// Path of a file named by the scene or on the command line. If the scene names it, it is relative to the scene's folder; else to the
  /// working directory.
  std::filesystem::path path_of(const std::string& file) const;
  /// Returns the error with place and key before its message.
  Error placed(ExitCode code, const std::string& message) const;
};

/// Reads the picture that `key` names, as NPY or a format of image_io::read, and adds it to `inputs`. Throws Error with the key if it
/// cannot be read.
image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs);
/// Decodes a picture file of that key.
image_io::Picture read_picture(const NamedFile& named, const std::string& file);
/// Adds the file, or the sequence that `file` describes, and the choices made in reading it.
void add_input(const NamedFile& named, const image_io::Picture& picture, InputFile file, Inputs& inputs);

/// Throws Error(usage) if `key` names a file that is unused because of the value of the key `why`.
void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why);

}  // namespace rainref::effect

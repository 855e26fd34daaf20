// Notes that rainref stores in a picture file, and the scene read back from them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "effect/inputs.h"
#include "image_io/notes.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// rainref:version, golden_generation, effect, variant, seed, frame. scene: the text of a scene whose last frame this picture is, with the
/// non-default keys. scene_hash: of all keys except run.frames, and of the decoded contents of the scene's files. picture_hash: as `rainref
/// hash` prints it for the displayed picture. Equal pictures of equal scenes have equal notes at any time and in any folder, because files
/// are named without their folders.
image_io::Notes picture_notes(const scene::Config& config, const effect::Inputs& inputs, int frame, const Image& picture);

/// "key hash first count" for each file that the scene names; equal if the contents are equal.
std::string inputs_text(const effect::Inputs& inputs);

/// The scene of a PNG or EXR file that rainref wrote, and its golden generation; nothing if the file is not a picture. Throws Error(usage)
/// if the file has no such note, is damaged, or names a file with a folder. Throws Error(io) if it cannot be read.
struct SceneOfPicture {
  std::string toml, golden_generation;
};
std::optional<SceneOfPicture> scene_of_picture(const std::filesystem::path& file);
/// Reads the text of a scene file, or of the scene in a picture that rainref wrote. Throws as scene_of_picture and scene::read_scene do.
std::string scene_text(const std::filesystem::path& file);

}  // namespace rainref::simulation

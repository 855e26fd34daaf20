// What rainref says of a picture in its file, and a scene taken back from there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "effect/inputs.h"
#include "image_io/notes.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// rainref:version, golden_generation, effect, variant, seed, frame; scene: the text of a scene whose last frame this picture is, with
/// the keys that are not as by default; scene_hash: of all keys but run.frames, and of what the scene's files hold once decoded;
/// picture_hash: what `rainref hash` says of the displayed picture. The same for equal pictures of equal scenes at any time, in any
/// folder: of files that the scene names only their own names are here, none of a folder.
image_io::Notes picture_notes(const scene::Config& config, const effect::Inputs& inputs, int frame, const Image& picture);

/// "key hash first count" for each file that the scene named: equal where these hold the same.
std::string inputs_text(const effect::Inputs& inputs);

/// The scene of a PNG or EXR file that rainref wrote, and the golden generation that it says; nothing where the file is neither.
/// Throws Error(usage) where the file has no such note, is damaged, or names a file with a folder, Error(io) where it cannot be read.
struct SceneOfPicture {
  std::string toml, golden_generation;
};
std::optional<SceneOfPicture> scene_of_picture(const std::filesystem::path& file);
/// The text of a scene file, or of the scene in a picture that rainref wrote. Throws as scene_of_picture and scene::read_scene.
std::string scene_text(const std::filesystem::path& file);

}  // namespace rainref::simulation

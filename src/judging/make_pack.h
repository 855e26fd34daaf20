// Writes packs, for `rainref pack`, rr_write_pack and Python's write_pack.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "capture/pack_write.h"
#include "effect/inputs.h"
#include "rainref/executor.h"
#include "scene/config.h"

namespace rainref::judging {

struct PackRequest {
  scene::Config config;
  std::string toml;             ///< the text of the scene, for its table `unexercised`
  std::filesystem::path scene;  ///< its file, for errors and the manifest
  std::filesystem::path output;
  std::vector<int> frames{};          ///< ascending
  bool may_add_frames = false;        ///< for passes that a null port would pass with these frames
  std::vector<std::string> passes{};  ///< empty: every pass of the variant
  bool is_for_one_use = false;        ///< of a random seed: names the passes whose outputs another seed does not change
  bool shows_coverage = false;        ///< lists the alternatives of each pass's text that no case takes
};
/// What is said meanwhile. None may be null.
struct PackEvents {
  std::function<void(const effect::Inputs&)> opened;  ///< the scene's files were read
  std::function<void(const std::string&)> line;       ///< a sentence about the pack, such as a pass that it leaves out
  std::function<void(int done, int of)> frame;        ///< after each frame; begins anew if the pack is written again
};
struct WrittenPack {
  capture::PackWriter::Total total;
  std::vector<std::string> passes;
};

/// Frames that a pack takes if none are asked for.
inline const std::vector<int> usual_frames{0, 1, 12};

/// Runs the scene from its first frame and writes a pack of the chosen passes and frames. Throws Error(usage) for an unknown pass, or a
/// picture with lossy coding; Error(io).
WrittenPack make_pack(const PackRequest& request, const parallel::Executor& executor, const PackEvents& events);

/// The scene's `seed` from the text of an option: a whole number, or "random" for one that nobody can predict. That is below 2^53, which
/// every reader of JSON keeps. Throws Error(usage) that begins with the option for any other text.
std::int64_t seed_of(const std::string& text, const char* option);

}  // namespace rainref::judging

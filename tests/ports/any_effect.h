// Packs of the two effects in examples/any_effect, made as its page says.
#pragma once

#include <memory>

#include "ports/support.h"

namespace rainref::ports {

/// A folder with a pack for each of the two, under its name.
class AnyEffect {
 public:
  static constexpr const char* effects[] = {"fogged_glass", "caustics"};

  /// Null where NumPy is missing, which makes the run.
  static const AnyEffect* made() {
    static const bool can = call("/usr/bin/python3 -c 'import numpy'").code == 0;
    static const std::unique_ptr<AnyEffect> all = can ? std::make_unique<AnyEffect>() : nullptr;
    return all.get();
  }
  AnyEffect() {
    const std::string run = (folder_ / "run").string();
    said_ = call("/usr/bin/python3 '" + source + "/examples/any_effect/make_run.py' '" + run + "'").text;
    for (const std::string effect : effects)
      said_ +=
          call(RAINREF_PROGRAM " pack --spirv '" + shaders(effect) + "/effect.json' --inputs '" + run + "' -o '" + pack(effect) + "'").text;
  }
  std::string pack(const std::string& effect) const { return (folder_ / effect).string(); }
  /// Where the build puts the SPIR-V: of the reference, and, in glsl, of the port.
  static std::string shaders(const std::string& effect) { return std::string(RAINREF_ANY_EFFECT) + "/" + effect; }
  /// What the programs printed meanwhile.
  const std::string& said() const { return said_; }

 private:
  TemporaryFolder folder_;
  std::string said_;
};

}  // namespace rainref::ports

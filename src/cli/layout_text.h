// What `rainref describe --layout` prints.
#pragma once

#include <optional>
#include <string>

#include "capture/pass_info.h"
#include "scene/uniform_layout.h"

namespace rainref::cli {

/// The uniform blocks, records and lists of an effect's passes, pass after pass: of all, or of one, in every variant or in one. Each
/// block and record is there once, before its first use. What one pass of one variant needs can be pasted into one shader: its bindings
/// differ, as port_runner numbers them. Throws Error(usage) naming the nearest pass or variant.
std::string layout_text(const capture::EffectInfo& effect, scene::Language language, const std::optional<std::string>& pass,
                        const std::optional<std::string>& variant);

}  // namespace rainref::cli

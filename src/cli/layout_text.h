// The output of `rainref describe --layout`.
#pragma once

#include <optional>
#include <string>

#include "capture/pass_info.h"
#include "scene/uniform_layout.h"

namespace rainref::cli {

/// The uniform blocks, records, images and lists of an effect's passes in order: of all passes or one, in all variants or one. Each block
/// and record appears once, before its first use. The text for one pass of one variant can be pasted into one shader: bindings depend on
/// the pass, as port_runner numbers them. Throws Error(usage) naming the nearest pass or variant.
std::string layout_text(const capture::EffectInfo& effect, scene::Language language, const std::optional<std::string>& pass,
                        const std::optional<std::string>& variant);

}  // namespace rainref::cli

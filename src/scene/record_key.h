// The key of a record: what names it, whatever its place in a list.
#pragma once

#include "scene/uniform_block.h"

namespace rainref::scene {

/// True if a member is the key of its record: `id`, one uint.
inline bool is_key(const Member& member) { return member.name == "id" && member.scalar == Scalar::uint32 && member.components == 1; }

}  // namespace rainref::scene

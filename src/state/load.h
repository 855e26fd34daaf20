// From a saved state back into what runs: looked through first, so that what does not fit changes nothing.
#pragma once

#include "state/file.h"

namespace rainref::state {

/// Throws Error(usage), naming the item, what is expected and what was found, unless the items of `saved` are those listed: the same
/// names in the same order, types, shapes (lengths within their limits), numbers within their ranges. Changes nothing.
void require_fit(const Saved& saved, const Items& items);
/// After require_fit: overwrites what is listed.
void load(const Saved& saved, const Items& items);

}  // namespace rainref::state

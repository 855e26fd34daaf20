// Text inside XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace rainref::reports {

/// Escapes text for content or for an attribute in double quotes, in XML 1.0 and HTML. Characters that neither allows (control characters,
/// bytes that are not UTF-8, the two non-characters) become U+FFFD. Tabs and newlines become references, because a parser would turn those
/// in an attribute into spaces.
std::string marked_up(std::string_view text);

}  // namespace rainref::reports

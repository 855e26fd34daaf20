// Text inside XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace rainref::reports {

/// Text as content or as the value of an attribute in double quotes, for XML 1.0 and for HTML. What neither can hold
/// (control characters, bytes that are no UTF-8, the two non-characters) becomes U+FFFD. Tabs and line ends stay, as
/// references, because a parser would turn those of an attribute into spaces.
std::string marked_up(std::string_view text);

}  // namespace rainref::reports

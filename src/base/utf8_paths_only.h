// Windows alone, before all else: std::filesystem::path would take the bytes of a char text one by one for letters. With this header such a
// path does not compile ("no matching function"); base/path_text.h makes it. Literals remain, which are ASCII, and so do pointers to char,
// of which CLI11 makes paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace std::filesystem::__detail {

template <>
inline constexpr bool __is_path_src<std::string> = false;
template <>
inline constexpr bool __is_path_src<std::string_view> = false;

}  // namespace std::filesystem::__detail

// Where the checkout lies, and what was made of it. Functions of one file rather than macros of all, so that objects are the same in every
// checkout.
#pragma once

#include <string>

namespace rainref::test {

/// Absolute, without a slash at its end.
std::string source_folder();
/// The folder of the small packs, which the build makes (tests/packs/CMakeLists.txt). Absolute, without a slash at its end.
std::string packs_folder();

}  // namespace rainref::test

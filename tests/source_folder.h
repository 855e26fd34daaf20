// Where the checkout lies. A function of one file rather than a macro of all, so that objects are the same in every checkout.
#pragma once

#include <string>

namespace rainref::test {

/// Absolute, without a slash at its end.
std::string source_folder();

}  // namespace rainref::test

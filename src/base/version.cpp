#include "rainref/version.h"

#define RAINREF_TEXT_(x) #x
#define RAINREF_TEXT(x) RAINREF_TEXT_(x)

namespace rainref {

const char* version() {
  return RAINREF_TEXT(RAINREF_VERSION_MAJOR) "." RAINREF_TEXT(RAINREF_VERSION_MINOR) "." RAINREF_TEXT(RAINREF_VERSION_PATCH);
}

}  // namespace rainref

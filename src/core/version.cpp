#include <skein/core/version.hpp>

#include "skein_version.hpp"

namespace skein {

const char* version() { return SKEIN_VERSION; }
const char* commit() { return SKEIN_COMMIT; }
const char* build_type() { return SKEIN_BUILD_TYPE; }

}  // namespace skein

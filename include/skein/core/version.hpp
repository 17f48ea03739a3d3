#pragma once

namespace skein {

/// "0.1.0".
const char* version();

/// Of the sources, with "-dirty" where they had changes; "unknown" outside a repository.
const char* commit();

/// "Release", "Debug", ...
const char* build_type();

}  // namespace skein

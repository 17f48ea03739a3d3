#include <skein/core/plain.hpp>

#include <toml++/toml.h>

#pragma once

#include <string>

namespace skein {

/// A JSON string. Bytes that are no UTF-8 become U+FFFD, so that every reader takes it.
std::string quote_json(const std::string& text);

}  // namespace skein

/// A look at TOML text before it is parsed: the parser recurses once a key part and would overflow its stack.
#pragma once

#include <string>
#include <string_view>

namespace tessera::app {

/// InputError naming origin:line:column where keys have more than 16 parts or brackets nest deeper than 16.
void refuse_deep_nesting(std::string_view text, const std::string& origin);

} // namespace tessera::app

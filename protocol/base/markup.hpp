#pragma once

#include <string>
#include <string_view>

namespace dripline {

/// `text` with `<`, `>`, `&` and double quotes as XML and HTML have them in texts and attributes;
/// all else as it is. Pure; any thread.
std::string escape_markup(std::string_view text);

}  // namespace dripline

#pragma once

#include <string>
#include <string_view>

namespace dripline::charts {

/// What no picture and no XML file can hold (control characters, damaged UTF-8) becomes U+FFFD.
std::string clean_text(std::string_view text);
/// The same, with `<`, `>`, `&` and double quotes as XML has them.
std::string xml_text(std::string_view text);

}  // namespace dripline::charts

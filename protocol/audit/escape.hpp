#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Fields of a line. Each text has exactly one escaped form.
namespace dripline::audit {

/// `\`, control characters and bytes outside ASCII as `\xHH`.
std::string escaped(std::string_view text);
/// nullopt: it is not what `escaped` makes of any text.
std::optional<std::string> unescaped(std::string_view text);
/// Between tabs; as many as there are tabs, and one more.
std::vector<std::string_view> fields_of(std::string_view line);

}  // namespace dripline::audit

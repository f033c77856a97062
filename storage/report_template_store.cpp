#include "storage/report_template_store.hpp"

#include <algorithm>
#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 3> kScopes{"program", "machine", "macro"};

}  // namespace

std::string_view to_string(TemplateScope scope) {
  return kScopes.at(static_cast<std::size_t>(scope));
}

Result<TemplateScope> parse_template_scope(std::string_view text) {
  const auto found = std::ranges::find(kScopes, text);
  if (found == kScopes.end())
    return fail(Errc::Syntax, "'{}' is none of program, machine, macro", text);
  return static_cast<TemplateScope>(found - kScopes.begin());
}

}  // namespace dripline::storage

#include "server/library/dialect_catalog.hpp"

#include "gateway/interpreter/core/memory_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::library {

std::vector<std::string> DialectCatalog::names() const {
  std::vector<std::string> names;
  for (const auto& dialect : interpreter::dialects()) names.emplace_back(dialect.name);
  return names;
}

std::vector<std::string> DialectCatalog::detect(std::string_view head,
                                                std::string_view program) const {
  std::vector<std::string> names;
  for (const auto* dialect : interpreter::detect_dialect(head, program)) {
    names.emplace_back(dialect->name);
  }
  return names;
}

Result<void> DialectCatalog::check_setup(std::string_view control, std::string_view toml) const {
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect) return fail(dialect.error());
  const auto data = interpreter::parse_control_data(toml, (*dialect)->units);
  if (!data) return fail(data.error());
  interpreter::MemorySource no_text("");
  interpreter::EventSink no_sink;
  const auto made = (*dialect)->make(*data, no_text, no_sink);
  if (!made) return fail(made.error());
  return {};
}

bool DialectCatalog::is_protected(std::string_view control, std::string_view head) const {
  const auto dialect = interpreter::find_dialect(control);
  return dialect && (*dialect)->is_protected != nullptr && (*dialect)->is_protected(head);
}

}  // namespace dripline::library

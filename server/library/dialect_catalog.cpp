#include "server/library/dialect_catalog.hpp"

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

}  // namespace dripline::library

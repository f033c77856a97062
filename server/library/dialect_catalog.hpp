#pragma once

#include "server/library/control_catalog.hpp"

namespace dripline::library {

/// The controls whose dialects are built into this program.
class DialectCatalog final : public ControlCatalog {
 public:
  std::vector<std::string> names() const override;
  std::vector<std::string> detect(std::string_view head, std::string_view program) const override;
  Result<void> check_setup(std::string_view control, std::string_view toml) const override;
  bool is_protected(std::string_view control, std::string_view head) const override;
};

}  // namespace dripline::library

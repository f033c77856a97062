#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/authority/identity.hpp"

namespace dripline::authority {

/// Every certificate that an authority has issued, the oldest first: without it none could be
/// revoked.
struct Ledger {
  std::string shop;
  std::vector<Issued> issued;

  /// The newest certificate of a holder; null: none was issued.
  const Issued* newest(const Holder& holder) const;
  bool revoke(const Holder& holder, UtcTime now);  ///< false: none was left to revoke
};

std::string write_ledger(const Ledger& ledger);
/// Errors: Corrupt.
Result<Ledger> parse_ledger(std::string_view text);

}  // namespace dripline::authority

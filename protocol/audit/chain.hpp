#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/signature.hpp"

/// Definition: README.md.
namespace dripline::audit {

struct Entry {
  std::uint64_t number = 0;  ///< 1, 2, 3 ...
  UtcTime time;
  std::string who, credential, address, action, subject, detail;
  friend bool operator==(const Entry&, const Entry&) = default;
};

/// Without its end of line.
std::string line_of(const Entry& entry);
/// Errors: Syntax (it is the line of no entry).
Result<Entry> parse_entry(std::string_view line);

Digest chain_begin(std::string_view database);
/// The digest of an entry, from that of the entry before.
Digest chain_next(const Digest& before, std::string_view line);

/// The chain up to an entry, signed by the server.
struct Checkpoint {
  std::uint64_t number = 0;  ///< of the checkpoint: 1, 2, 3 ...
  std::uint64_t entry = 0;
  UtcTime time;
  Digest digest;  ///< of that entry
  Signature signature;
  friend bool operator==(const Checkpoint&, const Checkpoint&) = default;
};

/// What is signed of it.
std::string checkpoint_text(const Checkpoint& checkpoint, std::string_view database);

}  // namespace dripline::audit

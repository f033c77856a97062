#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/audit/chain.hpp"

namespace dripline::audit {

/// Where a trail is not what was written.
struct Fault {
  std::uint64_t entry = 0;  ///< the first that is affected
  std::string what;
};

/// Reads a trail from its beginning: entries in the order of their numbers, each checkpoint after
/// the entry it is of (or after a later one). It continues after a fault, from what is stored
/// there, so that it knows the first and the last. Constant memory; one thread at a time.
class Verifier {
 public:
  Verifier(std::string database, const PublicKey& key)
      : database_(std::move(database)), key_(key), digest_(chain_begin(database_)) {}

  void take(const Entry& entry, const Digest& digest);
  void take(const Checkpoint& checkpoint);
  /// What its caller found wrong with an entry.
  void report(Fault fault);

  std::uint64_t entries() const { return entries_; }
  std::uint64_t last() const { return last_; }  ///< number of the entry taken last
  const Digest& digest() const { return digest_; }
  const std::optional<Checkpoint>& checkpoint() const { return checkpoint_; }  ///< the last
  const std::optional<Fault>& first_fault() const { return first_fault_; }
  /// The entry of the last fault; 0: none.
  std::uint64_t last_fault() const { return last_fault_; }

 private:
  std::string database_;
  PublicKey key_;
  Digest digest_;
  std::uint64_t last_ = 0, entries_ = 0, last_fault_ = 0;
  std::optional<Checkpoint> checkpoint_;
  std::optional<Fault> first_fault_;
};

/// Whether a checkpoint that was kept elsewhere belongs to a trail; `digest`: the trail's, of the
/// checkpoint's entry; absent: the trail ends before. Errors: Corrupt.
Result<void> check_kept(const Checkpoint& kept, const std::optional<Digest>& digest);

}  // namespace dripline::audit

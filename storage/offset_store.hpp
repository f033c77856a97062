#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"
#include "storage/setup_store.hpp"

namespace dripline::storage {

/// How deviations on a machine become corrections, every version of it.
struct OffsetRules {
  std::string machine;
  std::uint64_t version = 0;  ///< 1, 2, 3 ... per machine
  std::string text;           ///< TOML (server/offsets)
  std::string author;
  UtcTime created;
};

enum class OffsetState : std::uint8_t {
  Pending,
  Applied,
  Rejected,
  Superseded,  ///< by a newer proposal for the same value, or by another setup
};
std::string_view to_string(OffsetState state);
/// Errors: Syntax.
Result<OffsetState> parse_offset_state(std::string_view text);

/// A correction of one value of a machine's setup, and what became of it.
struct OffsetProposal {
  std::uint64_t id = 0;
  std::string machine, rule;
  std::string target;  ///< T3.wear.X, G54.Z, #500
  std::string unit;    ///< of both values: the setup's
  double old_value = 0, new_value = 0;
  std::uint64_t base = 0;  ///< the setup it was made from; 0: there was none
  OffsetState state = OffsetState::Pending;
  std::uint64_t used = 0, left_out = 0;  ///< measurements
  double mean = 0;                       ///< deviation, in the setup's unit, or degrees
  std::uint64_t first = 0, last = 0;     ///< measurements, by their ids
  std::string reasons;                   ///< JSON array of texts
  UtcTime created;
  std::optional<UtcTime> decided;  ///< absent: pending
  std::string who, comment;
  bool is_automatic = false;           ///< applied within the policy
  std::optional<std::uint64_t> setup;  ///< applied: the setup that it became
};

struct KeptProposal {
  OffsetProposal proposal;
  bool is_new = false;  ///< false: it was pending before
};

struct OffsetDecision {
  std::uint64_t id = 0;
  Actor who = {};
  std::string comment = {};
  UtcTime time = {};
  bool is_automatic = false;
};

struct OffsetFilter {
  std::optional<std::string> machine = {}, target = {};
  std::optional<OffsetState> state = {};
};

/// Errors: Conflict (it is decided already).
Result<void> check_pending(const OffsetProposal& proposal);

/// Rules and proposals. Promises of every store: storage/store.hpp.
class OffsetStore {
 public:
  virtual ~OffsetStore() = default;

  /// Makes `text` the machine's newest rules, or returns the newest when it has that text already.
  /// The audit entry (offset.rules) is part of the transaction. Errors: Syntax (the machine's
  /// name).
  virtual Result<OffsetRules> save_rules(const OffsetRules& rules, const Actor& who) = 0;
  /// The newest. Errors: NotFound.
  virtual Result<OffsetRules> rules(const std::string& machine) = 0;

  /// Keeps it as pending; the pending one for the same value is superseded. When that one is made
  /// of the same measurements and gives the same value it is returned, and nothing changes.
  /// `id`, `state` and what is decided are the store's own.
  virtual Result<KeptProposal> propose(const OffsetProposal& proposal) = 0;
  /// Nothing follows from the measurements any more: its pending proposal, if any, is superseded,
  /// with the reason as its comment.
  virtual Result<void> withdraw(const std::string& machine, const std::string& target, UtcTime now,
                                const std::string& reason) = 0;
  /// Errors: NotFound.
  virtual Result<OffsetProposal> find(std::uint64_t id) = 0;
  /// Newest first.
  virtual Result<std::vector<OffsetProposal>> list(const OffsetFilter& filter, Page page) = 0;

  /// The setup becomes the machine's next version and the proposal is applied, in one transaction
  /// with its audit entry (offset.apply): once, whatever is killed. Errors: NotFound, Conflict (it
  /// is decided already, or another setup than its base is the newest by now), those of
  /// SetupStore::save.
  virtual Result<SetupRevision> apply(const OffsetDecision& decision,
                                      const SetupRevision& setup) = 0;
  /// With its audit entry (offset.reject). Errors: NotFound, Conflict (it is decided already).
  virtual Result<OffsetProposal> reject(const OffsetDecision& decision) = 0;
};

}  // namespace dripline::storage

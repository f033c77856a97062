#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/audit/attestation.hpp"
#include "protocol/audit/trail_file.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/signature.hpp"
#include "server/library/health.hpp"
#include "storage/audit_store.hpp"

namespace dripline::library {

/// Verifies the chain of the audit trail and signs where it is. Any thread.
class AuditChain {
 public:
  struct Parts {
    storage::AuditStore& store;
    const Clock& clock;
    SigningKey key;
    std::string database;  ///< its identity
  };
  explicit AuditChain(Parts parts);

  struct Verification {
    UtcTime at;
    std::uint64_t entries = 0;
    std::optional<audit::Fault> fault = {};  ///< the first; absent: nothing was changed
  };
  struct State {
    std::optional<Verification> verification = {};  ///< of the whole trail; absent: not done yet
    std::optional<audit::Checkpoint> checkpoint = {};
  };
  State state() const;
  /// For the server's health.
  Health::Finding finding() const;
  audit::TrailHeader header() const { return {parts_.database, parts_.key.public_key()}; }

  /// The whole trail now, and a checkpoint of it. Errors: Busy (another is verified), and those of
  /// the store.
  Result<State> verify();

  /// To be called every few seconds: verifies what is new, a piece at a time, and signs a
  /// checkpoint a minute after the last one when there is something to sign. A day after a whole
  /// verification it begins again. What is not as it was written is not signed, and logged.
  Result<void> look();

  /// What the server states of a run, with its signature.
  std::string attest(const std::vector<audit::Fact>& facts) const {
    return audit::attestation_text(facts, parts_.key);
  }

  /// The trail as a file, piece by piece: nullopt at its end. Keep it on one thread at a time.
  std::function<Result<std::optional<std::string>>()> exported() const;

  static constexpr std::uint64_t kPiece = 10'000;
  static constexpr std::chrono::minutes kCheckpointEvery{1};
  static constexpr std::chrono::hours kVerifyEvery{24};

 private:
  /// A trail that is read from its beginning.
  struct Pass {
    audit::Verifier verifier;
    std::optional<audit::Checkpoint> next;  ///< read, but of an entry that was not reached yet
    bool has_checkpoints_left = true;
  };
  Pass begin_pass() const;
  /// True: the end was reached.
  Result<bool> read_piece(Pass& pass) const;
  Result<void> take_checkpoints(Pass& pass, std::uint64_t before) const;
  Result<void> end_pass(Pass& pass);
  Result<void> sign(Pass& pass);
  void note(const Pass& pass);

  const Parts parts_;
  std::mutex pass_mutex_;  ///< held by the thread that verifies
  Pass pass_;              ///< of `look`
  SteadyTime began_, signed_;
  mutable std::mutex mutex_;
  State state_;
};

}  // namespace dripline::library

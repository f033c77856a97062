#include "protocol/audit/verifier.hpp"

namespace dripline::audit {

void Verifier::report(Fault fault) {
  last_fault_ = std::max(last_fault_, fault.entry);
  if (!first_fault_ || fault.entry < first_fault_->entry) first_fault_ = std::move(fault);
}

void Verifier::take(const Entry& entry, const Digest& digest) {
  const std::uint64_t expected = last_ + 1;
  if (entry.number > expected) {
    const std::uint64_t through = entry.number - 1;
    report({expected, through == expected
                          ? fmt::format("entry {} was removed", expected)
                          : fmt::format("entries {} to {} were removed", expected, through)});
    // Without the one before it, it is unknown whether this one is genuine.
    last_fault_ = std::max(last_fault_, entry.number);
  } else if (entry.number < expected) {
    report(
        {entry.number, fmt::format("entry {} was inserted after entry {}", entry.number, last_)});
  } else if (chain_next(digest_, line_of(entry)) != digest) {
    report({entry.number, fmt::format("entry {} is not what was written as entry {}: it was "
                                      "changed, or something was removed or inserted there",
                                      entry.number, entry.number)});
  }
  digest_ = digest;
  last_ = entry.number;
  ++entries_;
}

void Verifier::take(const Checkpoint& checkpoint) {
  const std::uint64_t known = checkpoint_ ? checkpoint_->entry : 0;
  const std::uint64_t before = checkpoint_ ? checkpoint_->number : 0;
  checkpoint_ = checkpoint;
  if (!is_signed_by(key_, checkpoint_text(checkpoint, database_), checkpoint.signature)) {
    return report({checkpoint.entry, fmt::format("checkpoint {} (entry {}) is not signed by this "
                                                 "server",
                                                 checkpoint.number, checkpoint.entry)});
  }
  if (checkpoint.number != before + 1) {
    report({checkpoint.entry, fmt::format("checkpoint {} follows checkpoint {}: those between were "
                                          "removed",
                                          checkpoint.number, before)});
  }
  if (checkpoint.entry > last_) {
    report({last_ + 1, fmt::format("entries {} to {} were removed: checkpoint {} has them",
                                   last_ + 1, checkpoint.entry, checkpoint.number)});
  } else if (checkpoint.entry == last_ && checkpoint.digest != digest_) {
    // A fault since the last checkpoint explains it; otherwise it is unknown where it began.
    const std::uint64_t place = last_fault_ > known ? checkpoint.entry : known + 1;
    report({place, fmt::format("entries {} to {} are not those of checkpoint {}: the chain was "
                               "computed again",
                               known + 1, checkpoint.entry, checkpoint.number)});
  } else if (checkpoint.entry < last_) {
    report({checkpoint.entry, fmt::format("checkpoint {} (entry {}) stands after entry {}",
                                          checkpoint.number, checkpoint.entry, last_)});
  }
}

Result<void> check_kept(const Checkpoint& kept, const std::optional<Digest>& digest) {
  if (!digest) {
    return fail(Errc::Corrupt, "the trail ends before entry {}, which the kept checkpoint {} has",
                kept.entry, kept.number);
  }
  if (*digest == kept.digest) return {};
  return fail(Errc::Corrupt,
              "entry {} is not the one that the kept checkpoint {} has: the trail up to there was "
              "changed and computed again",
              kept.entry, kept.number);
}

}  // namespace dripline::audit

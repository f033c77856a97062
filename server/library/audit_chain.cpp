#include "server/library/audit_chain.hpp"

#include <memory>

#include "protocol/process/log.hpp"

namespace dripline::library {

AuditChain::AuditChain(Parts parts)
    : parts_(std::move(parts)), pass_(begin_pass()), began_(parts_.clock.steady_now()) {}

AuditChain::Pass AuditChain::begin_pass() const {
  return {.verifier = audit::Verifier(parts_.database, parts_.key.public_key()), .next = {}};
}

AuditChain::State AuditChain::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Health::Finding AuditChain::finding() const {
  const State now = state();
  const bool is_changed = now.verification && now.verification->fault;
  return {.level = is_changed ? Health::Level::Degraded : Health::Level::Ok,
          .subject = "audit",
          .what = "the audit trail was changed",
          .detail = is_changed ? now.verification->fault->what : ""};
}

/// Those of entries before `before`.
Result<void> AuditChain::take_checkpoints(Pass& pass, std::uint64_t before) const {
  constexpr std::uint64_t kNone = 0;
  while (pass.has_checkpoints_left) {
    if (!pass.next) {
      const auto& last = pass.verifier.checkpoint();
      auto read = parts_.store.checkpoints(last ? last->number : kNone, 1);
      if (!read) return fail(read.error());
      pass.has_checkpoints_left = !read->empty();
      if (read->empty()) return {};
      pass.next = read->front();
    }
    if (pass.next->entry >= before) return {};
    pass.verifier.take(*pass.next);
    pass.next.reset();
  }
  return {};
}

Result<bool> AuditChain::read_piece(Pass& pass) const {
  const auto entries = parts_.store.chained(pass.verifier.last(), kPiece);
  if (!entries) return fail(entries.error());
  for (const auto& chained : *entries) {
    if (auto taken = take_checkpoints(pass, chained.entry.number); !taken)
      return fail(taken.error());
    pass.verifier.take(chained.entry, chained.digest);
    if (!chained.run_fault.empty()) pass.verifier.report({chained.entry.number, chained.run_fault});
  }
  return entries->size() < kPiece;
}

Result<void> AuditChain::end_pass(Pass& pass) {
  constexpr std::uint64_t kAll = UINT64_MAX;
  if (auto taken = take_checkpoints(pass, kAll); !taken) return taken;
  const auto run = parts_.store.run_without_end();
  if (!run) return fail(run.error());
  if (*run) {
    pass.verifier.report({pass.verifier.last() + 1,
                          fmt::format("run {} has ended, but no entry has its end", **run)});
  }
  return {};
}

/// What is not as it was written after the last checkpoint is never signed.
Result<void> AuditChain::sign(Pass& pass) {
  const audit::Verifier& verifier = pass.verifier;
  const auto& last = verifier.checkpoint();
  const std::uint64_t signed_entry = last ? last->entry : 0;
  if (verifier.last() <= signed_entry || verifier.last_fault() > signed_entry) return {};
  audit::Checkpoint checkpoint{.number = last ? last->number + 1 : 1,
                               .entry = verifier.last(),
                               .time = parts_.clock.now(),
                               .digest = verifier.digest(),
                               .signature = {}};
  checkpoint.signature = parts_.key.sign(audit::checkpoint_text(checkpoint, parts_.database));
  if (auto added = parts_.store.add_checkpoint(checkpoint); !added) return added;
  // The log is the first place elsewhere.
  process::log_info("audit checkpoint={} entry={} sha256={}", checkpoint.number, checkpoint.entry,
                    checkpoint.digest.hex());
  pass.verifier.take(checkpoint);
  pass.has_checkpoints_left = true;
  return {};
}

void AuditChain::note(const Pass& pass) {
  const Verification now{parts_.clock.now(), pass.verifier.entries(), pass.verifier.first_fault()};
  const std::lock_guard lock(mutex_);
  const bool was_faulty = state_.verification && state_.verification->fault;
  if (now.fault && !was_faulty)
    process::log_error("the audit trail was changed: {}", now.fault->what);
  state_.verification = now;
  state_.checkpoint = pass.verifier.checkpoint();
}

Result<AuditChain::State> AuditChain::verify() {
  const std::unique_lock busy(pass_mutex_, std::try_to_lock);
  if (!busy) return fail(Errc::Busy, "the audit trail is being verified");
  Pass pass = begin_pass();
  for (bool is_over = false; !is_over;) {
    const auto read = read_piece(pass);
    if (!read) return fail(read.error());
    is_over = *read;
  }
  if (auto ended = end_pass(pass); !ended) return fail(ended.error());
  if (auto made = sign(pass); !made) return fail(made.error());
  note(pass);
  pass_ = std::move(pass);
  began_ = signed_ = parts_.clock.steady_now();
  return state();
}

Result<void> AuditChain::look() {
  const std::unique_lock busy(pass_mutex_, std::try_to_lock);
  if (!busy) return {};
  const SteadyTime now = parts_.clock.steady_now();
  if (now - began_ >= kVerifyEvery) {
    pass_ = begin_pass();
    began_ = now;
  }
  constexpr int kPiecesALook = 10;  // some tenths of a second
  bool is_over = false;
  for (int piece = 0; piece < kPiecesALook && !is_over; ++piece) {
    const auto read = read_piece(pass_);
    if (!read) return fail(read.error());
    is_over = *read;
  }
  if (!is_over) return {};
  if (auto ended = end_pass(pass_); !ended) return ended;
  if (now - signed_ >= kCheckpointEvery || !state().verification) {
    if (auto made = sign(pass_); !made) return made;
    signed_ = now;
  }
  note(pass_);
  return {};
}

std::function<Result<std::optional<std::string>>()> AuditChain::exported() const {
  struct Export {
    std::uint64_t after = 0, entries = 0, checkpoint = 0;
    std::optional<audit::Checkpoint> next;
    bool has_begun = false, has_ended = false;
  };
  auto at = std::make_shared<Export>();
  const auto checkpoints = [this, at](std::uint64_t before, std::string& text) -> Result<void> {
    for (;;) {
      if (!at->next) {
        auto read = parts_.store.checkpoints(at->checkpoint, 1);
        if (!read) return fail(read.error());
        if (read->empty()) return {};
        at->next = read->front();
      }
      if (at->next->entry >= before) return {};
      text += audit::checkpoint_line(*at->next);
      at->checkpoint = at->next->number;
      at->next.reset();
    }
  };
  return [this, at, checkpoints]() -> Result<std::optional<std::string>> {
    constexpr std::uint64_t kLines = 1000;
    if (at->has_ended) return std::nullopt;
    std::string text = at->has_begun ? "" : audit::header_line(header());
    at->has_begun = true;
    const auto entries = parts_.store.chained(at->after, kLines);
    if (!entries) return fail(entries.error());
    for (const auto& chained : *entries) {
      if (auto added = checkpoints(chained.entry.number, text); !added) return fail(added.error());
      text += audit::entry_line(chained.entry, chained.digest);
      at->after = chained.entry.number;
      ++at->entries;
    }
    if (entries->size() == kLines) return text;
    if (auto added = checkpoints(at->after + 1, text); !added) return fail(added.error());
    if (at->next) {  // of an entry that was written meanwhile, or was removed
      const auto more = parts_.store.chained(at->after, 1);
      if (!more) return fail(more.error());
      if (!more->empty()) return text;
      if (auto added = checkpoints(UINT64_MAX, text); !added) return fail(added.error());
    }
    text += audit::end_line(at->entries);
    at->has_ended = true;
    return text;
  };
}

}  // namespace dripline::library

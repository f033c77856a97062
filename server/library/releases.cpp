#include "server/library/releases.hpp"

#include <algorithm>

#include "protocol/base/utf8.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

using storage::RevisionState;
using storage::RunAllowance;

/// "in review".
std::string state_words(RevisionState state) {
  std::string words(storage::to_string(state));
  std::ranges::replace(words, '_', ' ');
  return words;
}

Result<void> check_comment(const Releases::Request& request, const StepRule& rule) {
  const std::string& comment = request.comment;
  if (comment.size() > Releases::kMaxComment) {
    return fail(Errc::LimitExceeded, "comment of {} bytes: at most {}", comment.size(),
                Releases::kMaxComment);
  }
  const bool has_words = comment.find_first_not_of(" \t\r\n") != std::string::npos;
  if (has_words || !rule.needs_comment) return {};
  return fail(Errc::Syntax, "the policy asks for a comment to {}",
              storage::to_string(request.step));
}

Result<void> check_role(const Releases::Request& request, const StepRule& rule) {
  if (request.role >= rule.role) return {};
  return fail(Errc::Denied, "{} has the role {}: the policy asks for {} to {}", request.who.name,
              storage::to_string(request.role), storage::to_string(rule.role),
              storage::to_string(request.step));
}

}  // namespace

/// One fact a line; the comment, which may have lines itself, as its digest.
std::string decision_text(const storage::Decision& decision, const std::string& database) {
  return fmt::format(
      "dripline decision 1\ndatabase {}\nprogram {}\nrevision {}\nsha256 {}\nstep {}\ntime {}\n"
      "who {}\ncredential {}\naddress {}\ncomment {}\npolicy {}\n",
      database, decision.program, decision.revision, decision.content.hex(),
      storage::to_string(decision.step), decision.time.time_since_epoch().count(),
      sha256(decision.who.name).hex(), sha256(decision.who.credential).hex(),
      sha256(decision.who.address).hex(), sha256(decision.comment).hex(), decision.policy.hex());
}

Result<storage::Revision> Releases::decide(const Request& request) {
  const StepRule& rule = policy_.rule(request.step);
  if (auto good = check_role(request, rule); !good) return fail(good.error());
  if (auto good = check_comment(request, rule); !good) return fail(good.error());
  const auto revision = parts_.programs.revision(request.program, request.revision);
  if (!revision) return revision;
  if (!rule.from.contains(revision->state)) {
    return fail(Errc::Conflict,
                "program {} revision {} is {}: the policy has no step {} from there",
                revision->program, revision->number, state_words(revision->state),
                storage::to_string(request.step));
  }
  if (rule.needs_four_eyes) {
    const auto authors = parts_.decisions.authors(revision->content);
    if (!authors) return fail(authors.error());
    if (authors->contains(request.who.name)) {
      return fail(
          Errc::Denied, "{} pushed program {} revision {}: the policy asks for another to {}",
          request.who.name, revision->program, revision->number, storage::to_string(request.step));
    }
  }
  storage::Decision decision;
  decision.program = revision->program;
  decision.revision = revision->number;
  decision.content = revision->content;
  decision.step = request.step;
  decision.time = parts_.clock.now();
  decision.who = request.who;
  decision.comment = request.comment;
  decision.policy = policy_.digest;
  decision.signature = parts_.key.sign(text_of(decision));
  auto decided = parts_.decisions.decide(decision, revision->state);
  if (decided) {
    process::log_info("program={} revision={} {} by={}", decided->program, decided->number,
                      storage::to_string(decided->state), request.who.name);
  }
  return decided;
}

bool Releases::proves_out(const Wish& wish) const {
  return policy_.prove_out_machines.contains(wish.machine) && wish.role >= policy_.prove_out_role;
}

/// The revision that is meant, whether or not it may run.
Result<storage::Revision> Releases::wanted(const Wish& wish) {
  auto latest = parts_.programs.revision(wish.program, wish.revision);
  if (!latest || wish.revision) return latest;
  const bool needs_release = policy_.runs_released_only && !proves_out(wish);
  const auto fits = [&](const storage::Revision& revision) {
    if (needs_release) return revision.state == RevisionState::Released;
    return revision.state != RevisionState::Withdrawn;
  };
  if (fits(*latest)) return latest;
  const auto all = parts_.programs.revisions(wish.program);
  if (!all) return fail(all.error());
  const auto found = std::ranges::find_if(
      *all, [&](const auto& revision) { return !revision.is_held && fits(revision); });
  if (found == all->end()) return latest;
  return parts_.programs.revision(wish.program, found->number);
}

/// The decision that released it, for a run that began at `moment`. All decisions about it must be
/// this server's.
Result<storage::Decision> Releases::verify(const storage::Revision& revision, UtcTime moment) {
  const auto decisions = parts_.decisions.decisions(revision.program, revision.number);
  if (!decisions) return fail(decisions.error());
  for (const auto& decision : *decisions) {
    const bool is_about_it =
        decision.revision == revision.number && decision.content == revision.content;
    const bool is_ours = is_signed_by(public_key(), text_of(decision), decision.signature);
    if (is_about_it && is_ours) continue;
    return fail(Errc::Corrupt,
                "program {} revision {}: decision {} ({} by {}) is not signed by this server: the "
                "database was changed",
                revision.program, revision.number, decision.id, storage::to_string(decision.step),
                decision.who.name);
  }
  const auto release =
      std::ranges::find(*decisions, storage::RevisionStep::Release, &storage::Decision::step);
  const auto withdrawal =
      std::ranges::find(*decisions, storage::RevisionStep::Withdraw, &storage::Decision::step);
  if (release == decisions->end()) {
    return fail(Errc::Corrupt,
                "program {} revision {} is released, but no decision released it: the database was "
                "changed",
                revision.program, revision.number);
  }
  if (withdrawal != decisions->end() && withdrawal->time <= moment) {
    return fail(Errc::Corrupt,
                "program {} revision {} is released, but decision {} withdrew it: the database was "
                "changed",
                revision.program, revision.number, withdrawal->id);
  }
  if (release->program == revision.program) return *release;
  return fail(Errc::Conflict,
              "program {} revision {} was released as {}: rename it back, or copy it and release "
              "the copy",
              revision.program, revision.number, release->program);
}

Result<Releases::Admission> Releases::admit(const Wish& wish) {
  auto revision = wanted(wish);
  if (!revision) return fail(revision.error());
  const std::string what = fmt::format("program {} revision {} is {}", revision->program,
                                       revision->number, state_words(revision->state));
  if (revision->state == RevisionState::Withdrawn) return fail(Errc::Conflict, "{}", what);
  if (!policy_.runs_released_only) return Admission{*std::move(revision)};
  if (revision->state == RevisionState::Released) {
    const auto approval = verify(*revision, UtcTime::max());
    if (!approval) return fail(approval.error());
    return Admission{*std::move(revision), RunAllowance::Released, approval->id};
  }
  if (proves_out(wish)) return Admission{*std::move(revision), RunAllowance::ProveOut};
  if (!policy_.prove_out_machines.contains(wish.machine)) {
    return fail(Errc::Conflict, "{}: machine '{}' runs released revisions only", what,
                wish.machine);
  }
  return fail(Errc::Conflict, "{}: machine '{}' runs what is not released only when a {} starts it",
              what, wish.machine, storage::to_string(policy_.prove_out_role));
}

std::optional<storage::Revision> Releases::offered(const storage::ProgramSummary& program,
                                                   const std::string& machine) {
  const bool is_open =
      !policy_.runs_released_only && program.latest.state != RevisionState::Withdrawn;
  if (is_open || program.is_removed || program.latest.is_held) return program.latest;
  if (policy_.runs_released_only && !program.released) return std::nullopt;
  auto admitted = admit({.machine = machine, .program = program.latest.program});
  if (!admitted) return std::nullopt;
  return std::move(admitted->revision);
}

bool Releases::may_call(const storage::Revision& revision, const storage::Run& run) {
  if (revision.is_held || revision.in_force_since() > run.created) return false;
  if (run.allowed_as == RunAllowance::Released) return revision.was_released_at(run.created);
  return !revision.was_withdrawn_at(run.created);
}

Result<void> Releases::check_call(const storage::Revision& revision, const storage::Run& run) {
  if (run.allowed_as != RunAllowance::Released) return {};
  const auto approval = verify(revision, run.created);
  if (!approval) return fail(approval.error());
  if (approval->time <= run.created) return {};
  return fail(Errc::Corrupt,
              "program {} revision {} was released after run {} began: the database was changed",
              revision.program, revision.number, run.id);
}

}  // namespace dripline::library

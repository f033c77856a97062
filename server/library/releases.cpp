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

/// One fact a line; the comment, which may have lines itself, as its digest. What is pinned comes
/// last, so that a decision without it has the text it always had.
std::string decision_text(const storage::Decision& decision, const std::string& database) {
  std::string text = fmt::format(
      "dripline decision 1\ndatabase {}\nprogram {}\nrevision {}\nsha256 {}\nstep {}\ntime {}\n"
      "who {}\ncredential {}\naddress {}\ncomment {}\npolicy {}\n",
      database, decision.program, decision.revision, decision.content.hex(),
      storage::to_string(decision.step), decision.time.time_since_epoch().count(),
      sha256(decision.who.name).hex(), sha256(decision.who.credential).hex(),
      sha256(decision.who.address).hex(), sha256(decision.comment).hex(), decision.policy.hex());
  if (!decision.closure) return text;
  text += fmt::format("closure {}\n", decision.closure->size());
  for (const storage::Pin& pin : *decision.closure)
    text += fmt::format("calls {} {} {}\n", pin.program, pin.revision, pin.content.hex());
  return text;
}

/// The step as it would be stored, if it may be taken.
Result<storage::DecisionFrom> Releases::decision(const Request& request,
                                                 const storage::Revision& revision) {
  const StepRule& rule = policy_.rule(request.step);
  if (!rule.from.contains(revision.state)) {
    return fail(Errc::Conflict,
                "program {} revision {} is {}: the policy has no step {} from there",
                revision.program, revision.number, state_words(revision.state),
                storage::to_string(request.step));
  }
  if (rule.needs_four_eyes) {
    const auto authors = parts_.store.releases.authors(revision.content);
    if (!authors) return fail(authors.error());
    if (authors->contains(request.who.name)) {
      return fail(
          Errc::Denied, "{} pushed program {} revision {}: the policy asks for another to {}",
          request.who.name, revision.program, revision.number, storage::to_string(request.step));
    }
  }
  storage::Decision decision;
  decision.program = revision.program;
  decision.revision = revision.number;
  decision.content = revision.content;
  decision.step = request.step;
  decision.time = parts_.clock.now();
  decision.who = request.who;
  decision.comment = request.comment;
  decision.policy = policy_.digest;
  return storage::DecisionFrom{std::move(decision), revision.state};
}

Result<storage::Revision> Releases::decide(const Request& request) {
  const StepRule& rule = policy_.rule(request.step);
  if (auto good = check_role(request, rule); !good) return fail(good.error());
  if (auto good = check_comment(request, rule); !good) return fail(good.error());
  const auto revision = parts_.store.programs.revision(request.program, request.revision);
  if (!revision) return revision;
  auto step = decision(request, *revision);
  if (!step) return fail(step.error());
  auto decided = release_together(request, *std::move(step));
  if (decided) {
    process::log_info("program={} revision={} {} by={}", decided->program, decided->number,
                      storage::to_string(decided->state), request.who.name);
  }
  return decided;
}

/// The step, after the releases of what it pins and was not released before.
Result<storage::Revision> Releases::release_together(const Request& request,
                                                     storage::DecisionFrom main) {
  std::vector<storage::DecisionFrom> decisions;
  if (request.closure) {
    if (auto whole = check_whole(*request.closure); !whole) {
      return fail(whole.error().code, "program {} revision {} is not released: {}",
                  main.decision.program, main.decision.revision, whole.error().what);
    }
    main.decision.closure.emplace();
    for (const auto& called : request.closure->called) {
      const storage::Revision& revision = called.revision;
      main.decision.closure->push_back({revision.program, revision.number, revision.content});
      const bool is_itself =
          revision.program == main.decision.program && revision.number == main.decision.revision;
      if (is_itself || revision.state == RevisionState::Released) continue;
      auto step = decision(request, revision);
      if (!step) return fail(step.error());
      step->decision.comment =
          fmt::format("with {} revision {}", main.decision.program, main.decision.revision);
      decisions.push_back(*std::move(step));
    }
  }
  decisions.push_back(std::move(main));
  for (auto& [decision, from] : decisions) decision.signature = parts_.key.sign(text_of(decision));
  return parts_.store.releases.decide_all(decisions);
}

bool Releases::proves_out(const Wish& wish) const {
  return policy_.prove_out_machines.contains(wish.machine) && wish.role >= policy_.prove_out_role;
}

/// The revision that is meant, whether or not it may run.
Result<storage::Revision> Releases::wanted(const Wish& wish) {
  auto latest = parts_.store.programs.revision(wish.program, wish.revision);
  if (!latest || wish.revision) return latest;
  const bool needs_release = policy_.runs_released_only && !proves_out(wish);
  const auto fits = [&](const storage::Revision& revision) {
    if (needs_release) return revision.state == RevisionState::Released;
    return revision.state != RevisionState::Withdrawn;
  };
  if (fits(*latest)) return latest;
  const auto all = parts_.store.programs.revisions(wish.program);
  if (!all) return fail(all.error());
  const auto found = std::ranges::find_if(
      *all, [&](const auto& revision) { return !revision.is_held && fits(revision); });
  if (found == all->end()) return latest;
  return parts_.store.programs.revision(wish.program, found->number);
}

/// The decision that released it. All decisions about it must be this server's. Anew: none
/// withdrew it, whatever the time of that is.
Result<storage::Decision> Releases::verify(const storage::Revision& revision, Asked asked) {
  const auto decisions = parts_.store.releases.decisions(revision.program, revision.number);
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
  if (withdrawal != decisions->end() && asked == Asked::Anew) {
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

/// None of what it pins was withdrawn, and all of it is as it was signed.
Result<void> Releases::check_pins(const storage::Decision& release) {
  if (!release.closure || release.closure->empty()) return {};
  const auto revisions = parts_.store.releases.pinned(release.id);
  if (!revisions) return fail(revisions.error());
  for (std::size_t i = 0; i < release.closure->size(); ++i) {
    const storage::Pin& pin = (*release.closure)[i];
    const bool is_bound = i < revisions->size() && (*revisions)[i].content == pin.content &&
                          (*revisions)[i].number == pin.revision;
    if (!is_bound) {
      return fail(Errc::Corrupt,
                  "program {} revision {} was released with {} revision {}, whose "
                  "row is another one: the database was changed",
                  release.program, release.revision, pin.program, pin.revision);
    }
    if ((*revisions)[i].state == RevisionState::Withdrawn) {
      return fail(Errc::Conflict,
                  "program {} revision {} calls {} revision {}, which was withdrawn",
                  release.program, release.revision, pin.program, pin.revision);
    }
  }
  return {};
}

/// Where releases are not asked for, one that pins what is called still decides that.
Result<Releases::Admission> Releases::admit_released(storage::Revision revision) {
  const auto decisions = parts_.store.releases.decisions(revision.program, revision.number);
  if (!decisions) return fail(decisions.error());
  const bool has_pins = std::ranges::any_of(
      *decisions, [](const auto& decision) { return decision.closure.has_value(); });
  if (!policy_.runs_released_only && !has_pins) return Admission{std::move(revision)};
  const auto approval = verify(revision, Asked::Anew);
  if (!approval) return fail(approval.error());
  if (auto good = check_pins(*approval); !good) return fail(good.error());
  const auto allowed_as = policy_.runs_released_only ? RunAllowance::Released : RunAllowance::Open;
  return Admission{std::move(revision), allowed_as, approval->id};
}

Result<std::optional<storage::Revision>> Releases::pinned_call(
    const storage::Run& run, const std::vector<std::string>& names) {
  if (!run.approval) return std::optional<storage::Revision>();
  storage::Revision main;
  main.program = run.program;
  main.number = run.revision;
  main.content = run.content;
  // It was not withdrawn when the run was stored (RunStore::create), and what it pins was not.
  const auto release = verify(main, Asked::Again);
  if (!release) return fail(release.error());
  if (release->id != *run.approval) {
    return fail(Errc::Corrupt,
                "run {} began under decision {}, but {} released its revision: the "
                "database was changed",
                run.id, *run.approval, release->id);
  }
  if (!release->closure) return std::optional<storage::Revision>();
  const auto revisions = parts_.store.releases.pinned(release->id);
  if (!revisions) return fail(revisions.error());
  for (const auto& name : names) {
    const auto pin = std::ranges::find(*release->closure, name, &storage::Pin::program);
    if (pin == release->closure->end()) continue;
    const auto place = static_cast<std::size_t>(pin - release->closure->begin());
    if (place < revisions->size() && (*revisions)[place].content == pin->content)
      return std::optional((*revisions)[place]);
    return fail(Errc::Corrupt,
                "program {} revision {} was released with {} revision {}, whose row "
                "is another one: the database was changed",
                run.program, run.revision, pin->program, pin->revision);
  }
  return fail(Errc::NotFound, "program {} revision {} was released without a program '{}'",
              run.program, run.revision, names.empty() ? "" : names.front());
}

Result<Releases::Admission> Releases::admit(const Wish& wish) {
  auto admitted = admit_by_state(wish);
  if (!admitted) return admitted;
  if (auto good = check_numbering(admitted->revision); !good) return fail(good.error());
  return admitted;
}

Result<Releases::Admission> Releases::admit_by_state(const Wish& wish) {
  auto revision = wanted(wish);
  if (!revision) return fail(revision.error());
  const std::string what = fmt::format("program {} revision {} is {}", revision->program,
                                       revision->number, state_words(revision->state));
  if (revision->state == RevisionState::Withdrawn) return fail(Errc::Conflict, "{}", what);
  if (revision->state == RevisionState::Released) return admit_released(*std::move(revision));
  if (!policy_.runs_released_only) return Admission{*std::move(revision)};
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
  const std::string& control = program.latest.control;
  const bool may_be_parameters = control.empty() || control == "centurion";
  if (is_open && may_be_parameters && !check_numbering(program.latest)) return std::nullopt;
  if (is_open || program.is_removed || program.latest.is_held) return program.latest;
  if (policy_.runs_released_only && !program.released) return std::nullopt;
  auto admitted = admit({.machine = machine, .program = program.latest.program});
  if (!admitted) return std::nullopt;
  return std::move(admitted->revision);
}

bool Releases::may_call(const storage::Revision& revision, const storage::Run& run) {
  if (!revision.was_in_force_for(run.number)) return false;
  if (run.allowed_as == RunAllowance::Released) return revision.was_released_for(run.number);
  return !revision.was_withdrawn_for(run.number);
}

Result<void> Releases::check_call(const storage::Revision& revision, const storage::Run& run) {
  if (run.allowed_as != RunAllowance::Released) return {};
  const bool is_kept = revision.state == RevisionState::Withdrawn;
  const auto approval = verify(revision, is_kept ? Asked::Again : Asked::Anew);
  return approval ? Result<void>() : fail(approval.error());
}

}  // namespace dripline::library

#include "server/offsets/offsets.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "gateway/interpreter/dialects/fanuc/memory/offset_text.hpp"
#include "protocol/process/log.hpp"
#include "server/offsets/deviations.hpp"
#include "server/offsets/memory_check.hpp"
#include "server/offsets/offsets_current.hpp"
#include "server/offsets/rule_check.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetProposal;

constexpr const char* kPolicy = "offset rules";  ///< no user has a blank in his name
std::string reasons_json(const std::vector<std::string>& reasons) {
  return nlohmann::json(reasons).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Result<void> Offsets::check_rules(const Current& now, const std::vector<OffsetRule>& rules) {
  for (const OffsetRule& rule : rules) {
    const auto target = parse_setup_target(rule.target);
    if (!target) return fail(target.error());
    if (const auto lack = what_control_lacks(now.control, *target); !lack.empty())
      return fail(Errc::Unsupported, "rule {}: target {}: {}", rule.name, rule.target, lack);
    if (now.setup == 0) continue;  // it may come later: until then nothing is proposed
    const auto absent = what_is_absent(now.place(), *target);
    if (!absent) return fail(absent.error());
    if (!absent->empty()) return fail(Errc::Conflict, "rule {}: {}", rule.name, *absent);
  }
  return check_corrected_once(rules, now.control);
}

Result<void> Offsets::withdraw_of_gone(const std::string& machine,
                                       const std::vector<OffsetRule>& rules) {
  storage::OffsetFilter filter{
      .machine = machine, .target = {}, .state = storage::OffsetState::Pending};
  const auto pending = parts_.store.offsets.list(filter, {.limit = 2 * kMaxRules});
  if (!pending) return fail(pending.error());
  for (const OffsetProposal& proposal : *pending) {
    const auto is_its = [&](const OffsetRule& rule) { return is_of_rule(proposal, rule); };
    if (std::ranges::any_of(rules, is_its)) continue;
    process::log_info(
        "offset proposal {} machine={} is withdrawn: there is no such rule {} any more",
        proposal.id, machine, proposal.rule);
    if (auto done = parts_.store.offsets.withdraw(
            machine, proposal.target, parts_.clock.now(),
            fmt::format("there is no such rule {} any more", proposal.rule));
        !done)
      return done;
  }
  return {};
}

Offsets::~Offsets() {
  end();
}

void Offsets::end() {
  worker_.request_stop();
  if (worker_.joinable()) worker_.join();
}

void Offsets::begin() {
  if (const auto machines = parts_.store.machines.list()) {
    const std::scoped_lock lock(mutex_);
    for (const auto& machine : *machines) noted_.insert(machine.name);
  }
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Offsets::note(const std::string& machine) {
  {
    const std::scoped_lock lock(mutex_);
    noted_.insert(machine);
  }
  changed_.notify_one();
}

void Offsets::publish(const OffsetProposal& proposal) {
  if (parts_.on_change) parts_.on_change(proposal);
}

Result<Offsets::Current> Offsets::current_of(const std::string& machine) {
  const auto known = parts_.store.machines.find(machine);
  if (!known) return fail(known.error());
  Current now{.machine = machine, .control = known->control, .text = {}, .unit = {}};
  const auto setup = parts_.store.setups.find(machine, std::nullopt);
  if (!setup && setup.error().code != Errc::NotFound) return fail(setup.error());
  if (setup) {
    now.text = setup->text;
    now.setup = setup->number;
  }
  auto loaded = parts_.store.setups.loaded(machine);
  if (!loaded) return fail(loaded.error());
  now.loaded = *std::move(loaded);
  auto unit = unit_in_force(now.text, now.control);
  if (!unit) return fail(unit.error());
  now.unit = *std::move(unit);
  return now;
}

/// Why a control that is loaded by hand could not be given the setup; empty: it can.
Result<std::string> Offsets::what_form_lacks(const Current& now, const std::string& text) {
  const bool is_lathe = now.control == "fanuc-t";
  if (!is_lathe && now.control != "fanuc") return std::string();
  if (!now.loaded) return std::string();
  const auto setup = interpreter::parse_control_data(text);
  if (!setup) return fail(setup.error());
  const auto form = interpreter::fanuc::write_offset_text(*setup, is_lathe);
  return form ? std::string() : "the control cannot be loaded with it: " + form.error().what;
}

/// What a control that is loaded by hand waits for; empty: nothing.
std::string Offsets::what_is_not_loaded(const Current& now) {
  if (!now.loaded || now.loaded->number == now.setup) return {};
  return fmt::format(
      "{} is recorded as loaded in the control, and setup {} is the newest: load it there, "
      "then `dnc setup loaded {} {}`",
      now.loaded->number ? fmt::format("setup {}", *now.loaded->number)
                         : std::string("no known setup"),
      now.setup, now.machine, now.setup);
}

/// Why the value is not to be written into the setup; empty: nothing speaks against it.
Result<std::string> Offsets::doubt_of(const Current& now, const OffsetRule& rule, double value) {
  const auto target = parse_setup_target(rule.target);
  if (!target) return fail(target.error());
  if (auto lack = what_control_lacks(now.control, *target); !lack.empty()) return lack;
  auto absent = what_is_absent(now.place(), *target);
  if (!absent || !absent->empty()) return absent;
  const auto changed = with_value(now.text, *target, value, kDecimals);
  if (!changed) return changed.error().what;
  auto form = what_form_lacks(now, *changed);
  if (!form || !form->empty()) return form;
  return doubt_of_step(parts_.store, {now.machine, now.control, rule.target, now.text, *changed});
}

/// What follows from the measurements alone.
Result<Evaluation> Offsets::measured(const Current& now, const OffsetRule& rule) {
  const auto target = parse_setup_target(rule.target);
  if (!target) return fail(target.error());
  const auto value = value_in_setup(now.text, *target);
  if (!value) return fail(value.error());
  const auto since = in_force_since(
      parts_.store.setups, {now.machine, now.control, now.text, now.setup}, *target, rule.tool);
  if (!since) return fail(since.error());
  const auto until =
      differed_until(parts_.store, {now.machine, now.control, rule.target, now.text, {}});
  if (!until) return fail(until.error());
  const auto found = find_deviations(parts_.store, {.machine = now.machine,
                                                    .unit = now.unit,
                                                    .rule = rule,
                                                    .target = *target,
                                                    .since = *since,
                                                    .differed_until = *until});
  if (!found) return fail(found.error());
  Evaluation evaluation{.rule = rule,
                        .unit = now.unit,
                        .value = *value,
                        .since = since->setup,
                        .outcome = propose(found->deviations, *value, rule, found->unit),
                        .measured = found->deviations,
                        .proposal = {}};
  auto& reasons = evaluation.outcome.reasons;
  reasons.insert(reasons.begin(), found->left_out.begin(), found->left_out.end());
  if (now.setup == 0) {
    reasons.insert(reasons.begin(), "the machine has no setup on the server: nothing is proposed");
    evaluation.outcome.new_value.reset();
    evaluation.outcome.is_within_policy = false;
    return evaluation;
  }
  if (auto waiting = what_is_not_loaded(now); !waiting.empty())
    reasons.insert(reasons.begin(), std::move(waiting));
  return evaluation;
}

Result<Evaluation> Offsets::evaluate(const Current& now, const OffsetRule& rule) {
  auto evaluation = measured(now, rule);
  if (!evaluation) return evaluation;
  Outcome& outcome = evaluation->outcome;
  if (!outcome.new_value) return evaluation;
  const auto target = parse_setup_target(rule.target);
  if (!target) return fail(target.error());
  const auto kind = kind_of_x(now.text, now.control, *target);
  if (!kind) return fail(kind.error());
  if (!kind->empty()) outcome.reasons.push_back(words_of_x(rule, *kind));
  auto doubt = doubt_of(now, rule, *outcome.new_value);
  if (!doubt) return fail(doubt.error());
  if (doubt->empty()) {
    auto rejection = rejection_of(parts_.store.offsets, {now.machine, rule, evaluation->value,
                                                         *outcome.new_value, evaluation->measured});
    if (!rejection) return fail(rejection.error());
    doubt = std::move(rejection->doubt);
    // Derived again, measurements count as more of them.
    if (rejection->is_same_step && std::exchange(outcome.is_within_policy, false))
      outcome.reasons.push_back("it was rejected before, so it waits for a person");
  }
  if (!doubt->empty()) {
    outcome.reasons.push_back("nothing is proposed: " + *doubt);
    outcome.new_value.reset();
    outcome.is_within_policy = false;
  }
  return evaluation;
}

Result<void> Offsets::keep(const Current& now, Evaluation& evaluation) {
  const Outcome& outcome = evaluation.outcome;
  if (!outcome.new_value)
    return parts_.store.offsets.withdraw(now.machine, evaluation.rule.target, parts_.clock.now(),
                                         outcome.reasons.back());
  OffsetProposal proposal;
  proposal.machine = now.machine;
  proposal.rule = evaluation.rule.name;
  proposal.target = evaluation.rule.target;
  proposal.unit = now.unit;
  proposal.old_value = evaluation.value;
  proposal.new_value = *outcome.new_value;
  proposal.base = now.setup;
  proposal.used = outcome.used;
  proposal.left_out = outcome.left_out;
  proposal.mean = outcome.mean;
  proposal.first = outcome.first;
  proposal.last = outcome.last;
  proposal.reasons = reasons_json(outcome.reasons);
  proposal.created = parts_.clock.now();
  auto kept = parts_.store.offsets.propose(proposal);
  if (!kept) return fail(kept.error());
  evaluation.proposal = std::move(kept->proposal);
  if (kept->is_new) {
    process::log_info("offset proposal {} machine={} {}: {} to {} {}", evaluation.proposal->id,
                      now.machine, proposal.target, proposal.old_value, proposal.new_value,
                      proposal.unit);
    publish(*evaluation.proposal);
  }
  return {};
}

Result<storage::OffsetRules> Offsets::save_rules(const std::string& machine,
                                                 const std::string& text,
                                                 const storage::Actor& who) {
  const auto now = current_of(machine);
  if (!now) return fail(now.error());
  const auto rules = parse_offset_rules(text);
  if (!rules) return fail(rules.error());
  if (auto good = check_rules(*now, *rules); !good) return fail(good.error());
  const auto before = parts_.store.offsets.rules(machine);
  if (!before && before.error().code != Errc::NotFound) return fail(before.error());
  auto saved = parts_.store.offsets.save_rules({.machine = machine,
                                                .version = 0,
                                                .text = text,
                                                .author = who.name,
                                                .created = parts_.clock.now()},
                                               who);
  if (!saved) return saved;
  note(machine);
  auto still_there = *rules;
  if (const auto old = before ? parse_offset_rules(before->text) : rules; old) {
    // What it proposed when it was for others is not its proposal: it is made again, or not.
    std::erase_if(still_there, [&](const OffsetRule& rule) {
      return std::ranges::any_of(*old, [&](const OffsetRule& one) {
        return one.name == rule.name && !has_same_scope(one, rule);
      });
    });
  }
  if (auto done = withdraw_of_gone(machine, still_there); !done) return fail(done.error());
  return saved;
}

Result<std::vector<Evaluation>> Offsets::look(const std::string& machine) {
  const std::scoped_lock one_at_a_time(look_mutex_);
  const auto stored = parts_.store.offsets.rules(machine);
  if (!stored && stored.error().code == Errc::NotFound) return std::vector<Evaluation>();
  if (!stored) return fail(stored.error());
  const auto rules = parse_offset_rules(stored->text);
  if (!rules) return fail(rules.error());
  if (auto done = withdraw_of_gone(machine, *rules); !done) return fail(done.error());
  std::vector<Evaluation> evaluations;
  for (const OffsetRule& rule : *rules) {
    const auto now = current_of(machine);  // each time: the rule before may have changed it
    if (!now) return fail(now.error());
    auto evaluation = evaluate(*now, rule);
    if (!evaluation) return fail(evaluation.error());
    if (auto kept = keep(*now, *evaluation); !kept) return fail(kept.error());
    if (evaluation->outcome.is_within_policy && evaluation->proposal) {
      const auto applied =
          approve({.id = evaluation->proposal->id,
                   .who = kPolicy,
                   .comment = fmt::format("within the policy, version {}", stored->version),
                   .time = {},
                   .is_automatic = true});
      if (applied) {
        evaluation->proposal = *applied;
      } else {
        evaluation->outcome.reasons.push_back("not applied: " + applied.error().what);
      }
    }
    evaluations.push_back(*std::move(evaluation));
  }
  return evaluations;
}

void Offsets::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::set<std::string> machines;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [this] { return !noted_.empty(); });
      machines.swap(noted_);
    }
    for (const std::string& machine : machines) {
      if (stop.stop_requested()) return;
      const auto looked = look(machine);
      if (looked || looked.error().code == Errc::NotFound) continue;
      process::log_warning("offsets of machine={} were not looked at: {}", machine,
                           looked.error().what);
    }
  }
}

}  // namespace dripline::offsets

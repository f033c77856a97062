#include "server/measurements/derivation.hpp"

#include <algorithm>

#include "protocol/measurement/cut_line.hpp"

namespace dripline::measurements {
namespace {

using measurement::Verdict;
using report_template::Action;
using report_template::Finding;
using report_template::FindingKind;
using report_template::PartBegun;
using report_template::PartEnded;
using report_template::PartSummary;
using report_template::Value;

bool is_report(const storage::Record& record) {
  return record.kind == "output" || record.kind == "probe" || record.kind == "message";
}

Action action_for(const report_template::ReportTemplate& content, Verdict verdict) {
  switch (verdict) {
    case Verdict::Good:
      return Action::None;
    case Verdict::Unknown:
      return content.on_unknown;
    case Verdict::Rework:
      return content.on_rework;
    case Verdict::Scrap:
      return content.on_scrap;
  }
  return Action::None;
}

}  // namespace

Derivation::Derivation(std::string machine, MachineState state, Sources sources,
                       std::uint64_t next_part_id)
    : machine_(std::move(machine)),
      state_(std::move(state)),
      sources_(std::move(sources)),
      next_part_id_(next_part_id) {
  batch_.machine = machine_;
  for (Session& session : state_.sessions) session.part.machine = machine_;
}

Result<std::vector<UsedTemplate>> Derivation::templates() {
  if (state_.is_foreign) return std::vector<UsedTemplate>();
  return sources_.templates(machine_, state_.program);
}

Result<void> Derivation::begin() {
  if (!state_.run.empty()) return {};
  auto wanted = templates();
  if (!wanted) return fail(wanted.error());
  const auto is_same = [](const Session& a, const UsedTemplate& b) {
    return a.used.name == b.name && a.used.version == b.version &&
           a.used.is_of_macro == b.is_of_macro;
  };
  if (std::equal(state_.sessions.begin(), state_.sessions.end(), wanted->begin(), wanted->end(),
                 is_same)) {
    return {};
  }
  // A part of a template that is not in force any more is over when the next record comes.
  std::vector<Session> sessions;
  for (UsedTemplate& used : *wanted) {
    const auto old = std::ranges::find_if(
        state_.sessions, [&](const Session& session) { return is_same(session, used); });
    if (old != state_.sessions.end()) {
      sessions.push_back(std::move(*old));
      old->part.id = 0;
    } else {
      sessions.emplace_back(std::move(used));
    }
  }
  for (Session& session : state_.sessions) {
    if (session.part.id == 0) continue;
    session.part.ended = session.part.begun;
    for (const auto& event : session.interpreter.end()) {
      // No record is at hand that a finding could name.
      if (const auto* ended = std::get_if<PartEnded>(&event))
        session.part.verdict = ended->part.verdict;
    }
    save_part(session.part);
  }
  state_.sessions = std::move(sessions);
  return {};
}

Result<void> Derivation::take(const storage::Record& record) {
  const bool is_end = record.kind == "run_ended";
  if (!is_report(record) && !is_end && record.kind != "run_started") return {};
  if (record.run != state_.run) {
    if (auto ended = end_parts(record); !ended) return ended;
    if (auto entered = enter_run(record); !entered) return entered;
  }
  item_ = 0;
  if (is_end) return end_parts(record);
  if (is_report(record)) take_line(record);
  return {};
}

Result<void> Derivation::enter_run(const storage::Record& record) {
  state_.run = record.run;
  state_.program.clear();
  state_.revision = 0;
  state_.is_foreign = false;
  if (!record.run.empty()) {
    const auto run = sources_.run(record.run);
    if (!run) return fail(run.error());
    if (*run) {
      state_.is_foreign = (*run)->machine != machine_;
      state_.program = (*run)->program;
      state_.revision = (*run)->revision;
    }
  }
  auto used = templates();
  if (!used) return fail(used.error());
  state_.sessions.clear();
  for (UsedTemplate& one : *used) state_.sessions.emplace_back(std::move(one));
  return {};
}

Result<std::string> Derivation::cut_of_run() const {
  if (state_.run.empty()) return std::string();
  const auto run = sources_.run(state_.run);
  if (!run) return fail(run.error());
  if (!*run || (*run)->state == storage::RunState::Completed) return std::string();
  if (!storage::is_finished((*run)->state)) return std::string("has not ended");
  return fmt::format("ended {}", storage::to_string((*run)->state));
}

Result<void> Derivation::end_parts(const storage::Record& record) {
  std::string cut;
  if (std::ranges::any_of(state_.sessions, [](const Session& one) { return one.part.id != 0; })) {
    auto known = cut_of_run();
    if (!known) return fail(known.error());
    cut = *std::move(known);
  }
  for (Session& session : state_.sessions) apply(session, record, session.interpreter.end(cut));
  return {};
}

void Derivation::take_line(const storage::Record& record) {
  const report_template::ReportLine line{
      .text = record.text, .kind = record.kind, .device = record.device};
  if (measurement::is_cut(record.text)) return take_cut(record, line);
  bool is_expected = false;
  Session* open = nullptr;
  for (Session& session : state_.sessions) {
    const auto taken = session.interpreter.take(line);
    apply(session, record, taken.events);
    if (taken.is_understood) {
      update_part(session, session.interpreter.state().part);
      announce(session, false);
      return;
    }
    if (!session.interpreter.is_for(line)) continue;
    if (session.part.id != 0) open = &session;
    is_expected = is_expected || !session.used.is_of_macro || session.part.id != 0;
  }
  if (!is_expected || report_template::trimmed(record.text).empty()) return;
  if (open != nullptr) {
    ++open->unmatched;
    update_part(*open, open->interpreter.state().part);
  }
  add(open, record, Finding{FindingKind::Unmatched, ""});
}

/// A line that is not whole: nothing is taken from it, and none of the parts that it may belong to
/// is known any more.
void Derivation::take_cut(const storage::Record& record, const report_template::ReportLine& line) {
  for (Session& session : state_.sessions) {
    const auto taken = session.interpreter.take(line);
    const bool is_open = session.part.id != 0 || session.interpreter.state().is_open;
    if (session.used.is_of_macro && !is_open) continue;  // of no concern
    apply(session, record, taken.events);
    update_part(session, session.interpreter.state().part);
    announce(session, false);
  }
}

void Derivation::apply(Session& session, const storage::Record& record,
                       const std::vector<report_template::ReportEvent>& events) {
  for (const auto& event : events) {
    if (std::holds_alternative<PartBegun>(event)) begin_part(session, record);
    if (const auto* value = std::get_if<Value>(&event)) add(session, record, *value);
    if (const auto* finding = std::get_if<Finding>(&event)) add(&session, record, *finding);
    if (const auto* ended = std::get_if<PartEnded>(&event)) end_part(session, record, ended->part);
  }
}

void Derivation::begin_part(Session& session, const storage::Record& record) {
  session.part = {};
  session.part.id = next_part_id_++;
  session.part.machine = machine_;
  session.part.run = state_.run;
  session.part.program = state_.program;
  session.part.revision = state_.revision;
  session.part.template_name = session.used.name;
  session.part.template_version = session.used.version;
  session.part.begun = record.time;
  session.unmatched = 0;
  session.announced = Verdict::Good;
  save_part(session.part);
}

void Derivation::end_part(Session& session, const storage::Record& record,
                          const PartSummary& summary) {
  session.part.ended = record.time;
  update_part(session, summary);
  announce(session, true);
  session.part = {};
}

void Derivation::update_part(Session& session, const PartSummary& summary) {
  if (session.part.id == 0) return;
  session.part.number = summary.number;
  session.part.serial = summary.serial;
  session.part.measurements = summary.values;
  session.part.findings = summary.findings + session.unmatched;
  session.part.verdict = summary.verdict;
  save_part(session.part);
}

/// At once when it is outside its limits; otherwise when all is known of it.
void Derivation::announce(Session& session, bool is_final) {
  const auto& part = session.part;
  if (part.id == 0) return;
  const bool is_worse = part.verdict >= Verdict::Rework && part.verdict > session.announced;
  if (!is_worse && !is_final) return;
  const bool is_news = is_worse || part.verdict == Verdict::Unknown;
  const Action action = is_news ? action_for(*session.used.content, part.verdict) : Action::None;
  session.announced = worse(session.announced, part.verdict);
  judged_.push_back({part, action});
  if (action != Action::None) state_.due.push_back({part.id, action});
}

void Derivation::save_part(const storage::MeasuredPart& part) {
  // Nearly always one of the last.
  const auto found = std::find_if(batch_.parts.rbegin(), batch_.parts.rend(),
                                  [&](const auto& known) { return known.id == part.id; });
  if (found != batch_.parts.rend()) {
    *found = part;
  } else {
    batch_.parts.push_back(part);
  }
}

void Derivation::add(Session& session, const storage::Record& record, const Value& value) {
  measurement::Measurement made;
  made.machine = machine_;
  made.run = state_.run;
  made.program = state_.program;
  made.revision = state_.revision;
  made.block = record.block;
  made.line = record.line;
  made.part_id = session.part.id;
  made.tool = value.tool;
  made.characteristic = value.characteristic;
  made.actual = value.actual;
  made.time = record.time;
  made.record = {record.epoch, record.number};
  made.item = item_++;
  made.verdict = value.verdict;
  batch_.measurements.push_back(std::move(made));
}

void Derivation::add(const Session* session, const storage::Record& record,
                     const Finding& finding) {
  batch_.findings.push_back({.id = 0,
                             .machine = machine_,
                             .run = state_.run,
                             .part_id = session != nullptr ? session->part.id : 0,
                             .record = {record.epoch, record.number},
                             .time = record.time,
                             .kind = std::string(report_template::to_string(finding.kind)),
                             .text = finding.text.empty() ? record.text : finding.text});
}

}  // namespace dripline::measurements

#include "clients/tools/report_template/report_interpreter.hpp"

#include <algorithm>
#include <array>

#include "clients/tools/report_template/impl/kept_line.hpp"
#include "clients/tools/report_template/impl/value_maker.hpp"
#include "protocol/measurement/cut_line.hpp"

namespace dripline::report_template {
namespace {

using measurement::Verdict;

constexpr std::array<std::string_view, 6> kFindings{"unmatched", "bad_value", "missing",
                                                    "doubled",   "reordered", "incomplete"};

/// `line`'s own numbers have priority over those of earlier lines.
void add_missing(LineNumbers& line, const LineNumbers& before) {
  for (const auto& [name, member] : kLineNumbers) {
    if (!(line.*member)) line.*member = before.*member;
  }
  line.decimals = std::max(line.decimals, before.decimals);
}

bool is_whole(double value) {
  return value >= -1e9 && value <= 1e9 && value == static_cast<double>(std::int64_t(value));
}

}  // namespace

std::string_view to_string(FindingKind kind) {
  return kFindings.at(static_cast<std::size_t>(kind));
}

bool ReportInterpreter::is_for(const ReportLine& line) const {
  const auto& device = template_->device;
  return std::ranges::find(template_->sources, line.kind) != template_->sources.end() &&
         (device.empty() || line.kind != "output" || device == line.device);
}

Taken ReportInterpreter::take(const ReportLine& line) {
  Taken taken;
  if (!is_for(line)) return taken;
  if (measurement::is_cut(line.text)) {
    take_cut(line.text, taken);
    return taken;
  }
  const std::string_view printed = measurement::printed_line(line.text);
  const std::string made =
      line.kind == "probe" ? line_of_probe(printed, template_->probe_axes) : std::string();
  const std::string_view text = line.kind == "probe" ? std::string_view(made) : printed;
  if (!state_.last_end.empty() && state_.last_end != kept_line(trimmed(text)))
    state_.last_end.clear();
  if (state_.partial && take_partial(text, taken)) return taken;
  take_rule(text, taken);
  state_.is_after_cut = false;
  return taken;
}

/// The next of the lines that follow each other. What is ignored may be between them; anything else
/// ends the sequence.
bool ReportInterpreter::take_partial(std::string_view line, Taken& taken) {
  ReportState::Partial& partial = *state_.partial;
  if (next_of_partial() == nullptr) {
    state_.partial.reset();  // of another template
    return false;
  }
  const LineRule& rule = template_->rules[partial.rule];
  if (rule.steps[partial.step].match(line)) {
    partial.texts.emplace_back(trimmed(line));
    taken.is_understood = true;
    taken.rule = partial.rule;
    if (++partial.step < rule.steps.size()) return true;
    const ReportState::Partial whole = std::move(partial);
    state_.partial.reset();
    std::vector<FieldText> fields;
    for (std::size_t i = 0; i < whole.texts.size(); ++i) {
      const auto found = rule.steps[i].match(whole.texts[i]);
      if (found) fields.insert(fields.end(), found->begin(), found->end());
    }
    apply(whole.rule, fields, fmt::format("{}", fmt::join(whole.texts, " / ")), taken);
    return true;
  }
  for (std::size_t i = 0; i < template_->rules.size(); ++i) {
    const LineRule& other = template_->rules[i];
    if (!other.is_ignored || !other.steps.front().match(line)) continue;
    taken.is_understood = true;
    taken.rule = i;
    return true;
  }
  add_finding(FindingKind::Incomplete,
              fmt::format("'{}' did not come after '{}'", rule.steps[partial.step].text(),
                          partial.texts.back()),
              taken.events);
  state_.partial.reset();
  return false;
}

/// The form of the line that has to come; nullptr: none.
const LineForm* ReportInterpreter::next_of_partial() const {
  if (!state_.partial || state_.partial->rule >= template_->rules.size()) return nullptr;
  const auto& steps = template_->rules[state_.partial->rule].steps;
  return state_.partial->step < steps.size() ? &steps[state_.partial->step] : nullptr;
}

void ReportInterpreter::take_rule(std::string_view line, Taken& taken) {
  for (std::size_t i = 0; i < template_->rules.size(); ++i) {
    const LineRule& rule = template_->rules[i];
    const auto fields = rule.steps.front().match(line);
    if (!fields) continue;
    taken.is_understood = true;
    taken.rule = i;
    if (rule.is_ignored) return;
    begin_rule(i, *fields, trimmed(line), taken);
    return;
  }
}

void ReportInterpreter::begin_rule(std::size_t index, const std::vector<FieldText>& fields,
                                   std::string_view line, Taken& taken) {
  const LineRule& rule = template_->rules[index];
  if (state_.is_after_cut && refuses_rest(rule, fields, line, taken)) return;
  if (rule.steps.size() > 1) {
    state_.partial = ReportState::Partial{.rule = index, .step = 1, .texts = {std::string(line)}};
  } else {
    apply(index, fields, line, taken);
  }
}

ReportInterpreter::Fields ReportInterpreter::read_fields(
    const std::vector<FieldText>& texts) const {
  Fields made;
  for (const auto& [field, text] : texts) {
    const std::string_view shown = trimmed(text);
    if (!is_number(field->kind)) {
      if (shown.size() > kMaxName) {
        made.unusable[field->name] =
            fmt::format("{} of {} characters: at most {}", field->name, shown.size(), kMaxName);
        continue;
      }
      made.texts[field->name] = shown;
      continue;
    }
    const auto number = read_number(text);
    const bool is_count = field->kind == FieldKind::Count || field->kind == FieldKind::Expected;
    const bool is_of_count = field->kind == FieldKind::Count;
    const std::int64_t least = is_of_count ? template_->first_count : 0;
    std::string why;
    if (!number) {
      why = number.error().what;
    } else if (is_count && !is_whole(number->value)) {
      why = "no whole number, or too large";
    } else if (is_count && number->value < static_cast<double>(least)) {
      why = fmt::format("at least {}", least);
    }
    if (!why.empty()) {
      const std::string name = field->of.empty() ? field->name : field->name + "." + field->of;
      made.unusable[name] = fmt::format("{} '{}': {}", name, shown.substr(0, 40), why);
      continue;
    }
    if (is_count) {
      (is_of_count ? made.count : made.expected) = std::int64_t(number->value);
      continue;
    }
    LineNumbers& numbers = made.numbers[field->of];
    const auto* row = std::ranges::find(kLineNumbers, field->name, &LineNumberRow::name);
    numbers.*(row->member) = number->value;
    numbers.decimals = std::max(numbers.decimals, number->decimals);
  }
  return made;
}

void ReportInterpreter::apply(std::size_t index, const std::vector<FieldText>& texts,
                              std::string_view line, Taken& taken) {
  const LineRule& rule = template_->rules[index];
  auto& events = taken.events;
  for (const auto& [field, text] : texts) {
    taken.fields.emplace_back(field->of.empty() ? field->name : field->name + "." + field->of,
                              trimmed(text));
  }
  if (is_end_again(rule, texts, line)) {
    events.emplace_back(Finding{FindingKind::Doubled,
                                fmt::format("'{}' came again: its part has ended", trimmed(line))});
    return;
  }
  if (rule.starts_part) {
    break_part("the next part began", events);
    state_.cut.clear();  // it was none of this part
  }
  Fields fields = read_fields(texts);
  fields.line = line;
  if (keep_texts(rule, fields, events)) {
    ++state_.ordinals[index];
    // How many came before is not known after a line that is not whole.
    if (state_.cut.empty()) state_.context["ordinal"] = fmt::to_string(state_.ordinals[index]);
    take_values(rule, fields, events);
  }
  if (!rule.ends_part || !state_.is_open) return;
  close_part(events);
  state_.last_end = kept_line(line);
}

/// Texts and counts. False: the line came before, or its count is none, and it gives no values.
bool ReportInterpreter::keep_texts(const LineRule& rule, const Fields& fields,
                                   std::vector<ReportEvent>& events) {
  const auto serial = fields.texts.find("serial");
  if (serial != fields.texts.end() && !state_.part.serial.empty() &&
      serial->second != state_.part.serial) {
    break_part(fmt::format("serial number {} came", serial->second), events);
  }
  const bool restarts = fields.count == template_->first_count && state_.highest &&
                        *state_.highest > template_->first_count &&
                        std::ranges::none_of(template_->rules, &LineRule::starts_part);
  if (restarts) break_part(fmt::format("line {} came again", *fields.count), events);
  if (rule.starts_part || serial != fields.texts.end() || fields.texts.contains("part") ||
      fields.count || fields.expected || fields.unusable.contains("count")) {
    open_part(events);
  }
  // A value must not get the name that an earlier line had.
  for (const auto& [name, why] : fields.unusable) {
    state_.context.erase(name);
    add_fault(FindingKind::BadValue, why, events);
  }
  for (const auto& [name, text] : fields.texts) state_.context[name] = text;
  if (fields.count) state_.context["count"] = fmt::to_string(*fields.count);
  if (serial != fields.texts.end()) state_.part.serial = serial->second;
  if (const auto part = fields.texts.find("part"); part != fields.texts.end())
    state_.part.number = part->second;
  if (fields.expected) take_expected(*fields.expected, fields.line, events);
  if (fields.unusable.contains("count")) return false;
  return !fields.count || take_count(*fields.count, fields.line, events);
}

void ReportInterpreter::open_part(std::vector<ReportEvent>& events) {
  if (state_.is_open) return;
  state_.is_open = true;
  state_.expected = template_->expected;
  events.emplace_back(PartBegun{});
  report_cut(events);
}

void ReportInterpreter::take_values(const LineRule& rule, const Fields& fields,
                                    std::vector<ReportEvent>& events) {
  bool has_values = false;
  const auto text_of = [&](const char* name) {
    const auto found = state_.context.find(name);
    return found == state_.context.end() ? std::string() : found->second;
  };
  const bool has_named = std::ranges::any_of(fields.numbers, [](const auto& one) {
    return !one.first.empty() && (one.second.actual || one.second.deviation);
  });
  LineNumbers common;  // limits beside values that have names: they are for each of these
  for (const auto& [of, given] : fields.numbers) {
    LineNumbers numbers = given;
    if (of.empty()) {
      add_missing(numbers, state_.pending);
      state_.pending = {};
    } else if (const auto before = state_.pending_of.extract(of)) {
      add_missing(numbers, before.mapped());
    }
    if (!numbers.actual && !numbers.deviation) {
      if (of.empty()) {
        (has_named ? common : state_.pending) = numbers;
      } else {
        state_.pending_of[of] = numbers;
      }
      continue;
    }
    if (!of.empty()) add_missing(numbers, common);
    open_part(events);
    has_values = true;
    ValueParts parts{.raw = of.empty() ? text_of("characteristic") : of,
                     .name = {},
                     .numbers = numbers,
                     .unit = text_of("unit"),
                     .tool = text_of("tool")};
    auto named = state_.context;
    named["characteristic"] = parts.raw;
    const auto name = fill_in(
        rule.characteristic.empty() ? std::string("{characteristic}") : rule.characteristic, named);
    if (name) parts.name = *name;
    auto value = name ? make_value(*template_, rule, parts) : Result<Value>(fail(name.error()));
    if (value) {
      const auto& all = template_->characteristics;
      for (const std::string& key : {parts.name, parts.raw}) {
        const auto own = all.find(key);
        if (own != all.end() && own->second.is_required) state_.seen.insert(key);
      }
      add_value(*std::move(value), events);
    } else {
      add_fault(FindingKind::BadValue, value.error().what, events);
    }
  }
  if (has_values) ++state_.lines;
}

void ReportInterpreter::add_value(Value value, std::vector<ReportEvent>& events) {
  ++state_.part.values;
  const auto& made = value.characteristic;
  if (made.lower || made.upper) {
    state_.worst = state_.is_judged ? worse(state_.worst, value.verdict) : value.verdict;
    state_.is_judged = true;
  }
  update_verdict();
  events.emplace_back(std::move(value));
}

void ReportInterpreter::add_finding(FindingKind kind, std::string text,
                                    std::vector<ReportEvent>& events) {
  ++state_.part.findings;
  update_verdict();
  events.emplace_back(Finding{kind, std::move(text)});
}

void ReportInterpreter::add_fault(FindingKind kind, std::string text,
                                  std::vector<ReportEvent>& events) {
  state_.is_incomplete = true;
  add_finding(kind, std::move(text), events);
}

void ReportInterpreter::update_verdict() {
  state_.part.verdict = state_.is_judged ? state_.worst : Verdict::Unknown;
  if (state_.is_incomplete) state_.part.verdict = worse(state_.part.verdict, Verdict::Unknown);
}

void ReportInterpreter::close_part(std::vector<ReportEvent>& events) {
  if (!state_.is_open) return;
  find_missing(events);
  events.emplace_back(PartEnded{state_.part});
  state_ = {};
}

void ReportInterpreter::break_part(std::string_view why, std::vector<ReportEvent>& events) {
  const bool has_end = std::ranges::any_of(
      template_->rules, [](const LineRule& rule) { return rule.ends_part && !rule.is_ignored; });
  if (state_.is_open && has_end) {
    add_fault(FindingKind::Incomplete, fmt::format("the part's end did not come: {}", why), events);
  }
  close_part(events);
}

std::vector<ReportEvent> ReportInterpreter::end(std::string_view cut) {
  std::vector<ReportEvent> events;
  if (state_.is_open && !cut.empty()) {
    add_fault(FindingKind::Incomplete, fmt::format("the part's end did not come: its run {}", cut),
              events);
    close_part(events);
  } else {
    break_part("the report ended", events);
  }
  state_ = {};
  return events;
}

}  // namespace dripline::report_template

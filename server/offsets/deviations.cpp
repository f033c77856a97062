#include "server/offsets/deviations.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "protocol/base/units.hpp"

namespace dripline::offsets {
namespace {

using measurement::Measurement;
using storage::MeasuredPart;

constexpr std::uint64_t kMeasurementsBack = 5'000;  ///< under other setups, or without a nominal
constexpr std::uint64_t kPageSize = 500;

/// Why a measurement is left out, in the order in which the reasons name them.
enum class Left : std::uint8_t {
  OfOthers,
  WithoutSetup,
  BeforeChange,
  OtherMemory,
  OpenPart,
  UnknownPart,
  SamePart,
  OtherUnit
};
constexpr std::size_t kLefts = 8;

/// The runs of measurements, each asked for once.
class RunSetups {
 public:
  explicit RunSetups(storage::RunStore& runs) : runs_(runs) {}
  /// Nothing: there is no such run, or it had no setup of the server.
  std::optional<std::uint64_t> setup_of(const std::string& run) {
    if (run.empty()) return std::nullopt;
    const auto [found, is_new] = known_.try_emplace(run);
    if (is_new) {
      if (const auto stored = runs_.find(run)) found->second = stored->setup;
    }
    return found->second;
  }

 private:
  storage::RunStore& runs_;
  std::map<std::string, std::optional<std::uint64_t>> known_;
};

/// The parts of measurements, each asked for once.
class PartsOf {
 public:
  explicit PartsOf(storage::MeasurementStore& stored) : stored_(stored) {}
  /// Null: it is not there.
  const MeasuredPart* find(std::uint64_t id) {
    const auto [found, is_new] = known_.try_emplace(id);
    if (is_new) {
      if (auto stored = stored_.part(id)) found->second = *std::move(stored);
    }
    return found->second ? &*found->second : nullptr;
  }
  /// Whether the part's report contradicts itself, or has not all of its lines: has findings other
  /// than lines that the template does not know. Such a part is not good.
  bool is_in_doubt(const MeasuredPart& part) {
    if (part.verdict == measurement::Verdict::Good || part.findings == 0) return false;
    const auto [found, is_new] = faulty_.try_emplace(part.run);
    if (is_new) found->second = faulty_of(part);
    return !found->second || found->second->contains(part.id);
  }

 private:
  using Ids = std::set<std::uint64_t>;

  /// Those of the part's run; nothing: they are too many to be looked at, or cannot be read.
  std::optional<Ids> faulty_of(const MeasuredPart& part) {
    constexpr std::uint64_t kMost = 1000;
    const auto findings =
        stored_.findings({.machine = part.machine, .run = part.run}, {.limit = kMost});
    if (!findings || findings->size() == kMost) return std::nullopt;
    Ids ids;
    for (const storage::ReportFinding& one : *findings) {
      if (one.kind != "unmatched") ids.insert(one.part_id);
    }
    return ids;
  }

  storage::MeasurementStore& stored_;
  std::map<std::uint64_t, std::optional<MeasuredPart>> known_;
  std::map<std::string, std::optional<Ids>> faulty_;  ///< by run
};

/// Whether a rule is for measurements. In doubt it is not.
bool is_of(const OffsetRule& rule, const Measurement& one, PartsOf& parts) {
  if (!rule.program.empty() && one.program != rule.program) return false;
  if (!rule.tool.empty() && bare_tool(one.tool) != bare_tool(rule.tool)) return false;
  if (rule.template_name.empty()) return true;
  const MeasuredPart* part = parts.find(one.part_id);
  return part != nullptr && part->template_name == rule.template_name;
}

/// Each part of a report once, and each line of it, whichever template reads it.
class DistinctParts {
 public:
  bool is_new(const Measurement& one, const MeasuredPart& part) {
    const auto id = part.number.empty() ? part.id : 0;
    const bool is_new_part = parts_.emplace(part.run, part.template_name, part.number, id).second;
    const auto [line, is_new_line] = lines_.try_emplace(one.record, part.id);
    return is_new_part && (is_new_line || line->second == part.id);
  }

 private:
  std::set<std::tuple<std::string, std::string, std::string, std::uint64_t>> parts_;
  std::map<measurement::RecordKey, std::uint64_t> lines_;  ///< and who has read it
};

class DeviationSearch {
 public:
  DeviationSearch(const storage::Store& store, const DeviationQuery& query)
      : store_(store), query_(query), runs_(store.runs), parts_(store.measurements) {}

  Result<Measured> find() {
    const OffsetRule& rule = query_.rule;
    storage::MeasurementFilter filter;
    filter.machine = query_.machine;
    filter.characteristic = rule.characteristic;
    std::optional<storage::MeasurementPlace> before;
    for (std::uint64_t seen = 0; !is_full(); before = place_) {
      if (is_cut_ = seen >= kMeasurementsBack; is_cut_) break;
      const auto rows = store_.measurements.list_newest(filter, before, kPageSize);
      if (!rows) return fail(rows.error());
      for (const Measurement& m : *rows) {
        if (!is_full()) take(m);
      }
      seen += rows->size();
      if (rows->size() < kPageSize) break;
      place_ = {rows->back().time, rows->back().id};
    }
    std::ranges::reverse(found_.deviations);
    tell();
    return std::move(found_);
  }

 private:
  bool is_full() const { return found_.deviations.size() == query_.rule.window; }

  void take(const Measurement& m) {
    const auto off = measurement::deviation(m);
    if (!off) return;
    const auto setup = runs_.setup_of(m.run);
    const bool is_before = setup && *setup < query_.since.setup;
    if (!is_of(query_.rule, m, parts_)) {
      if (setup && !is_before) leave(Left::OfOthers);
      return;
    }
    if (!setup || query_.since.setup == 0) return leave(Left::WithoutSetup);
    if (is_before) return leave(Left::BeforeChange);
    if (query_.differed_until && m.time <= *query_.differed_until) return leave(Left::OtherMemory);
    const MeasuredPart* part = parts_.find(m.part_id);
    if (part == nullptr || !part->ended) return leave(Left::OpenPart);
    if (parts_.is_in_doubt(*part)) return leave(Left::UnknownPart);
    if (!distinct_.is_new(m, *part)) return leave(Left::SamePart);
    const auto value = in_unit(*off, m.characteristic.unit);
    if (!value) {
      other_units_.insert(m.characteristic.unit);
      return leave(Left::OtherUnit);
    }
    found_.deviations.push_back({m.id, *value});
  }

  /// Lengths in the setup's unit, angles in degrees. What a variable's number is in is not known:
  /// its deviations have one unit, that of the newest.
  std::optional<double> in_unit(double value, const std::string& unit) {
    const bool is_length = unit == "mm" || unit == "inch";
    const bool is_variable = query_.target.kind == SetupTarget::Kind::Variable;
    std::string then = query_.unit;
    if (is_variable ? !is_length : is_angle(query_.target)) then = is_variable ? unit : "deg";
    if (then == query_.unit ? !is_length : unit != then) return std::nullopt;
    if (found_.unit.empty()) found_.unit = then;
    if (found_.unit != then) return std::nullopt;
    if (unit == "mm" && then == "in") return value / Length::kMillimetersPerInch;
    if (unit == "inch" && then == "mm") return value * Length::kMillimetersPerInch;
    return value;
  }

  void leave(Left why) { ++left_.at(static_cast<std::size_t>(why)); }

  std::string words(Left why) const {
    const OffsetRule& rule = query_.rule;
    switch (why) {
      case Left::OfOthers:
        return fmt::format("under the value in force are left out: not {}", scope_text(rule));
      case Left::WithoutSetup:
        return "are left out: of runs without a setup of the server, so what was in force is not "
               "known (a control at the end of a line: dnc setup loaded)";
      case Left::BeforeChange:
        return fmt::format(
            "are left out: cut before setup {}, when {}", query_.since.setup,
            query_.since.change.empty() ? "it was not looked at" : query_.since.change);
      case Left::OtherMemory:
        return fmt::format(
            "are left out: cut while the control's memory had, or may have had, another number "
            "for {} than the setup",
            rule.target);
      case Left::OpenPart:
        return "are left out: their parts have not ended";
      case Left::UnknownPart:
        return "are left out: the reports of their parts have findings, and they are not good";
      case Left::SamePart:
        return "are left out: each part counts once, with its last one";
      case Left::OtherUnit:
        return fmt::format(
            "are left out: they are in {}, which is not converted to the {} of {}",
            fmt::join(other_units_, ", "),
            found_.unit.empty() ? is_angle(query_.target) ? "deg" : query_.unit : found_.unit,
            rule.target);
    }
    return {};
  }

  void tell() {
    for (std::size_t i = 0; i < kLefts; ++i) {
      if (left_.at(i) == 0) continue;
      found_.left_out.push_back(fmt::format("{} measurements of {} {}", left_.at(i),
                                            query_.rule.characteristic,
                                            words(static_cast<Left>(i))));
    }
    if (is_cut_) found_.left_out.emplace_back("older measurements were not looked at");
  }

  const storage::Store& store_;
  const DeviationQuery& query_;
  RunSetups runs_;
  PartsOf parts_;
  DistinctParts distinct_;
  Measured found_;
  std::array<std::uint64_t, kLefts> left_{};
  std::set<std::string> other_units_;
  storage::MeasurementPlace place_;
  bool is_cut_ = false;
};

}  // namespace

Result<Measured> find_deviations(const storage::Store& store, const DeviationQuery& query) {
  return DeviationSearch(store, query).find();
}

}  // namespace dripline::offsets

#include <nlohmann/json.hpp>

#include "clients/tools/report_template/taken_json.hpp"
#include "server/api/api.hpp"

namespace dripline::api {

namespace {

using nlohmann::ordered_json;

/// Records of a run that a template is tried on; longer ones are for `dnc report template try`.
constexpr std::uint64_t kMaxTried = 20'000;

/// What a template makes of each line of a run. Of the lines that are asked for the answer has all,
/// of the others it counts.
class Trial {
 public:
  Trial(report_template::ReportTemplate read, storage::Page page, bool only_unmatched)
      : interpreter_(std::make_shared<const report_template::ReportTemplate>(std::move(read))),
        page_(page),
        only_unmatched_(only_unmatched) {}

  void take(const storage::Record& record) {
    const report_template::ReportLine line{
        .text = record.text, .kind = record.kind, .device = record.device};
    if (!interpreter_.is_for(line)) return;
    const auto taken = interpreter_.take(line);
    ++lines_;
    if (!taken.is_understood) ++unmatched_;
    for (const auto& event : taken.events)
      measurements_ += std::holds_alternative<report_template::Value>(event) ? 1 : 0;
    if (only_unmatched_ && taken.is_understood) return;
    if (wanted_++ < page_.offset || shown_.size() >= page_.limit) return;
    const auto* rule =
        taken.is_understood ? &interpreter_.report_template().rules.at(taken.rule) : nullptr;
    shown_.push_back(report_template::taken_json(line.text, rule, taken));
  }
  /// `cut`: how a run ended that did not complete.
  ordered_json end(std::string_view cut) {
    auto events = ordered_json::array();
    for (const auto& event : interpreter_.end(cut))
      events.push_back(report_template::event_json(event));
    return {{"lines", lines_},
            {"unmatched", unmatched_},
            {"measurements", measurements_},
            {"shown", std::move(shown_)},
            {"at_end", std::move(events)}};
  }

 private:
  report_template::ReportInterpreter interpreter_;
  const storage::Page page_;
  const bool only_unmatched_;
  std::uint64_t lines_ = 0, unmatched_ = 0, measurements_ = 0, wanted_ = 0;
  ordered_json shown_ = ordered_json::array();
};

/// Nothing is stored.
Response try_template(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const bool only_unmatched = query.flag("unmatched");
  if (auto good = query.finish(); !good) return error_response(good.error());
  auto read = report_template::read_template(request.body);
  if (!read) return error_response(read.error());
  const auto run = services.runs.run(request.parameter("id"));
  if (!run) return error_response(run.error());
  const bool is_whole = run->state == storage::RunState::Completed;
  const std::string cut = is_whole || !storage::is_finished(run->state)
                              ? std::string()
                              : fmt::format("ended {}", storage::to_string(run->state));
  Trial trial(*std::move(read), page, only_unmatched);
  for (std::uint64_t offset = 0;; offset += kMaxLimit) {
    const auto records =
        services.runs.records(request.parameter("id"), "", {.limit = kMaxLimit, .offset = offset});
    if (!records) return error_response(records.error());
    if (offset >= kMaxTried && !records->empty()) {
      return error_response(
          {Errc::LimitExceeded,
           fmt::format("run {} has over {} records: dnc report template try takes them all",
                       request.parameter("id"), kMaxTried)});
    }
    for (const auto& record : *records) trial.take(record);
    if (records->size() < kMaxLimit) return json_text_response(trial.end(cut).dump());
  }
}

}  // namespace

void add_template_trial_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/runs/{id}/template-trial", with(services, try_template));
}

}  // namespace dripline::api

#include "server/library/history/run_facts.hpp"

#include <algorithm>

#include "server/library/history/test_runs.hpp"
#include "server/library/releases.hpp"

namespace dripline::library {
namespace {

class Facts {
 public:
  void add(std::string name, std::string value) {
    facts_.push_back({std::move(name), std::move(value)});
  }
  void add(std::string name, std::uint64_t value) { add(std::move(name), std::to_string(value)); }
  void add(std::string name, const std::optional<UtcTime>& time) {
    if (time) add(std::move(name), to_iso8601(*time));
  }
  std::vector<audit::Fact> take() { return std::move(facts_); }

 private:
  std::vector<audit::Fact> facts_;
};

void add_program(Facts& facts, const storage::Run& run) {
  facts.add("program", run.program);
  facts.add("revision", run.revision);
  facts.add("sha256", run.content.hex());
  facts.add("size", run.size);
}

void add_outcome(Facts& facts, const storage::Run& run) {
  facts.add("author", run.author);
  facts.add("created", std::optional(run.created));
  facts.add("started", run.started);
  facts.add("ended", run.ended);
  facts.add("state", std::string(storage::to_string(run.state)));
  facts.add("reason", run.reason);
  facts.add("executed_blocks", run.counters.executed);
  facts.add("last_line", run.line);
  const std::string what = is_test_run(run) ? "tested" : "executed";
  if (run.executed_content) facts.add(what + "_sha256", *run.executed_content);
  if (run.content_verified)
    facts.add(what + "_is_program", std::string(*run.content_verified ? "yes" : "no"));
}

Result<void> add_setup(Facts& facts, const storage::Store& store, const storage::Run& run) {
  if (run.gateway_setup) facts.add("gateway_setup_sha256", *run.gateway_setup);
  if (!run.setup) return {};
  const auto setup = store.setups.find(run.machine, *run.setup);
  if (!setup) return fail(setup.error());
  facts.add("setup", *run.setup);
  facts.add("setup_sha256", setup->sha256.hex());
  return {};
}

/// The revisions whose text the machine got, by the names that the program calls.
Result<void> add_calls(Facts& facts, const storage::Store& store, const storage::Run& run) {
  const auto calls = store.runs.calls(run.id);
  if (!calls) return fail(calls.error());
  facts.add("called_programs", calls->size());
  for (std::size_t i = 0; i < calls->size(); ++i) {
    const storage::RunCall& call = (*calls)[i];
    facts.add(fmt::format("called_{}", i + 1),
              fmt::format("{} = {} revision {} sha256 {}", call.name, call.program, call.revision,
                          call.content.hex()));
  }
  return {};
}

/// With the signed text, so that the decision can be checked without the server too.
Result<void> add_approval(Facts& facts, const storage::Store& store, const storage::Run& run,
                          const std::string& database) {
  facts.add("allowed_as", std::string(storage::to_string(run.allowed_as)));
  if (!run.approval) return {};
  const auto decisions = store.releases.decisions(run.program, run.revision);
  if (!decisions) return fail(decisions.error());
  const auto decision = std::ranges::find(*decisions, *run.approval, &storage::Decision::id);
  if (decision == decisions->end()) {
    return fail(Errc::Corrupt, "run {}: decision {}, which released it, is not there", run.id,
                *run.approval);
  }
  facts.add("approval", *run.approval);
  facts.add("approval_by", decision->who.name);
  facts.add("approval_text", decision_text(*decision, database));
  facts.add("approval_signature", decision->signature.hex());
  return {};
}

Result<void> add_end(Facts& facts, const storage::Store& store, const storage::Run& run) {
  const auto end = store.audit.run_end(run.id);
  if (!end) return fail(end.error());
  if (!*end) return fail(Errc::Corrupt, "run {} has ended, but no audit entry has its end", run.id);
  const auto& chained = **end;
  if (!chained.run_fault.empty()) return fail(Errc::Corrupt, "{}", chained.run_fault);
  facts.add("audit_entry", chained.entry.number);
  facts.add("audit_sha256", chained.digest.hex());
  return {};
}

}  // namespace

Result<std::vector<audit::Fact>> facts_of_run(const storage::Store& store, const std::string& id,
                                              const std::string& database) {
  const auto run = store.runs.find(id);
  if (!run) return fail(run.error());
  if (!storage::is_finished(run->state)) {
    return fail(Errc::Conflict, "run {} is {}: it is attested when it has ended", run->id,
                storage::to_string(run->state));
  }
  Facts facts;
  facts.add("database", database);
  facts.add("run", run->id);
  facts.add("machine", run->machine);
  facts.add("control", run->control);
  const auto machine = store.machines.find(run->machine);
  if (machine) facts.add("gateway_version", machine->gateway_version);  // as announced last
  add_program(facts, *run);
  if (auto added = add_calls(facts, store, *run); !added) return fail(added.error());
  if (auto added = add_setup(facts, store, *run); !added) return fail(added.error());
  if (auto added = add_approval(facts, store, *run, database); !added) return fail(added.error());
  add_outcome(facts, *run);
  if (auto added = add_end(facts, store, *run); !added) return fail(added.error());
  return facts.take();
}

}  // namespace dripline::library
